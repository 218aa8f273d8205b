// What `fit --json` prints.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/formats/results/result_type.hpp"
#include "measure/recording_fits.hpp"

namespace ballbar {

// As the file stores it, by the names of results; lacking where it stores none.
MayLack<TableOf<double>> stored_results(const std::vector<Compared>& results);

// Of a circle, and of an axial recording.
constexpr auto of_circle(auto get) {
  return [get](const FittedRecording& of) {
    using Type = std::remove_cvref_t<decltype(get(*of.circle))>;
    return MayLack<Type>{of.circle ? std::optional<Type>(get(*of.circle)) : std::nullopt};
  };
}
constexpr auto of_roundness(auto Circularity::*member) {
  return [member](const FittedRecording& of) {
    return MayLack<double>{of.circularity ? std::optional((*of.circularity).*member) : std::nullopt};
  };
}
constexpr auto of_axial(auto AxialLength::*member) {
  return [member](const FittedRecording& of) {
    return MayLack<double>{of.axial ? std::optional((*of.axial).*member) : std::nullopt};
  };
}
template <class Type>
constexpr auto if_circle(Type Recording::*member) {
  return [member](const FittedRecording& of) {
    return MayLack<Type>{of.circle ? std::optional(of.recording.*member) : std::nullopt};
  };
}

template <>
inline constexpr auto kResult<FittedRecording> = ResultType{
    "FittedRecording", "The circle of a recording, or the length of an axial one.",
    std::tuple{
        Field{"file", &FittedRecording::file, ""},
        Field{"index", &FittedRecording::index, "within the file"},
        Field{"kind", [](const FittedRecording& of) { return of.recording.kind; }, "circle, axial"},
        Field{"readings", [](const FittedRecording& of) { return of.recording.length_mm.size(); }, ""},
        Field{"nominal_length_mm",
              [](const FittedRecording& of) { return Known<double>{of.recording.nominal_length_mm}; }, ""},
        Field{"length_mm", of_axial(&AxialLength::length_mm), "of an axial one"},
        Field{"sigma_length_um", of_axial(&AxialLength::sigma_um), ""},
        Field{"plane", if_circle(&Recording::plane), "XY, YZ, ZX; this and what follows of a circle"},
        Field{"direction", if_circle(&Recording::direction), "CCW, CW"},
        Field{"arc_deg", of_circle([](const Circle& of) { return of.arc_deg; }), ""},
        Field{"model", of_circle([](const Circle& of) -> std::string_view {
                return of.model == CircleModel::polar ? "polar" : "length_equation";
              }),
              "length_equation, polar"},
        Field{"centre_a_um", of_circle([](const Circle& of) { return of.centre_a_um; }), ""},
        Field{"centre_b_um", of_circle([](const Circle& of) { return of.centre_b_um; }), ""},
        Field{"radius_mm", of_circle([](const Circle& of) { return of.radius_mm; }), ""},
        Field{"circularity_um", of_roundness(&Circularity::circular_deviation_um), "largest minus smallest deviation"},
        Field{"feed_mm_per_min",
              [](const FittedRecording&
                     of) { return MayLack<double>{of.circle ? of.recording.feed_mm_per_min : std::nullopt}; },
              "where it is known"},
        Field{"rms_um", [](const FittedRecording& of) { return of.axial ? of.axial->rms_um : of.circle->rms_um; },
              "of the residual"},
        Field{"sigma_centre_a_um", of_circle([](const Circle& of) { return of.sigma_centre_a_um(); }), ""},
        Field{"sigma_centre_b_um", of_circle([](const Circle& of) { return of.sigma_centre_b_um(); }), ""},
        Field{"sigma_radius_um", of_circle([](const Circle& of) { return of.sigma_radius_um(); }), ""},
        Field{"sigma_circularity_um", of_roundness(&Circularity::circular_deviation_sigma_um), ""},
        Field{"correlation_a_b", of_circle([](const Circle& of) { return of.correlation_a_b(); }), ""},
        Field{"correlation_a_radius", of_circle([](const Circle& of) { return of.correlation_a_radius(); }), ""},
        Field{"correlation_b_radius", of_circle([](const Circle& of) { return of.correlation_b_radius(); }), ""},
        Field{"sigma_reading_um", of_circle([](const Circle& of) { return of.sigma_reading_um; }), ""},
        Field{"autocorrelation", of_circle([](const Circle& of) { return of.autocorrelation; }), "of the residual"},
        Field{"effective_readings", of_circle([](const Circle& of) { return of.effective_readings; }),
              "equivalent number of independent readings"},
        Field{"max_circular_um", of_roundness(&Circularity::max_circular_um), "the largest deviation"},
        Field{"max_at_deg", of_roundness(&Circularity::max_at_deg), ""},
        Field{"min_circular_um", of_roundness(&Circularity::min_circular_um), "the smallest"},
        Field{"min_at_deg", of_roundness(&Circularity::min_at_deg), ""},
        Field{"converged", of_circle([](const Circle& of) { return of.converged; }), "whether the fit came to an end"},
        Field{"discounted", of_circle([](const Circle& of) { return of.discounted; }), "readings, with --robust"},
        Field{"stored",
              [](const FittedRecording&
                     of) { return of.circle ? stored_results(of.results) : MayLack<TableOf<double>>{}; },
              "what the file stores of these"}}};

template <>
inline constexpr auto kResult<FittedPair> =
    ResultType{"FittedPair", "The numbers of ISO 230-4 of both directions.",
               std::tuple{Field{"RESULT",
                                [](const FittedPair& of) {
                                  KeysOf<double> keys;
                                  for (const Compared& result : of.results)
                                    keys.values.emplace_back(result.key, result.ours);
                                  return keys;
                                },
                                "g_ccw_um, g_cw_um, bidirectional_2005_um, d_um, h_um, ..."},
                          Field{"stored", [](const FittedPair& of) { return stored_results(of.results); },
                                "what the file stores of these"},
                          Field{"remarks",
                                [](const FittedPair& of) {
                                  return MayLack<std::vector<std::string>>{
                                      of.remarks.empty() ? std::nullopt : std::optional(of.remarks)};
                                },
                                ""}}};

struct PairOfFile {
  FittedPair pair;
};

template <>
inline constexpr auto kResult<PairOfFile> = ResultType{
    "PairOfFile", "The numbers of ISO 230-4 of one of several pairs.",
    std::tuple_cat(std::tuple{Field{"file", [](const PairOfFile& of) { return of.pair.file; }, "of its first"}},
                   fields_through(&PairOfFile::pair, kResult<FittedPair>.fields))};

// A value that a file stores.
struct ValueAlone {
  std::string of, name;
  double value = 0.0;
  std::string unit;
};

template <>
inline constexpr auto kResult<ValueAlone> =
    ResultType{"ValueAlone", "A value that a file stores.",
               std::tuple{Field{"of", &ValueAlone::of, "run, with its direction, or analysis"},
                          Field{"name", &ValueAlone::name, "as the file has it"},
                          Field{"value", &ValueAlone::value, ""}, Field{"unit", &ValueAlone::unit, ""}}};
std::vector<ValueAlone> values_alone(const ResultsAlone& alone);

template <>
inline constexpr auto kResult<ResultsAlone> =
    ResultType{"ResultsAlone", "A file that stores results without readings.",
               std::tuple{Field{"file", &ResultsAlone::file, ""}, Field{"stored", &values_alone, ""}}};

inline constexpr std::tuple kPairFields{
    Field{"iso230_4",
          [](const std::vector<FittedPair>& pairs) {
            return MayLack<FittedPair>{pairs.size() == 1 ? std::optional(pairs.front()) : std::nullopt};
          },
          "of the only pair of CCW and CW: the numbers of ISO 230-4"},
    Field{"iso230_4_pairs",
          [](const std::vector<FittedPair>& pairs) {
            MayLack<std::vector<PairOfFile>> several;
            if (pairs.size() < 2) return several;
            several.value.emplace();
            for (const FittedPair& pair : pairs) several.value->push_back({pair});
            return several;
          },
          "of several pairs, each with its file"}};

template <>
inline constexpr auto kResult<Fitted> = ResultType{
    "Fitted", "The circles of recordings.",
    std::tuple_cat(std::tuple{Field{"recordings", &Fitted::recordings, "one row per recording"},
                              Field{"results_alone",
                                    [](const Fitted& of) {
                                      return MayLack<std::vector<ResultsAlone>>{
                                          of.results_alone.empty() ? std::nullopt : std::optional(of.results_alone)};
                                    },
                                    "files that store results without readings"}},
                   fields_through(&Fitted::pairs, kPairFields))};

}  // namespace ballbar
