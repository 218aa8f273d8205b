// What `fit --json` prints.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "ballbar/formats/results/result_type.hpp"
#include "measure/recording_fits.hpp"

namespace ballbar {

constexpr std::string_view name_of(CircleModel model) {
  return model == CircleModel::polar ? "polar" : "length_equation";
}

// As the file stores them, by the names of results.
TableOf<double> stored_results(const std::vector<Compared>& results);

// Of a circle, its circularity, its recording; and of an axial recording.
constexpr auto of_circle(auto get) { return may_lack(in(&FittedRecording::circle, get)); }
constexpr auto of_roundness(auto get) { return may_lack(in(&FittedRecording::circularity, get)); }
constexpr auto of_axial(auto get) { return may_lack(in(&FittedRecording::axial, get)); }
constexpr auto if_circle(auto... get) {
  return where([](const FittedRecording& of) { return of.circle.has_value(); }, in(get...));
}

template <>
inline constexpr auto kResult<FittedRecording> = ResultType(
    "FittedRecording", "The circle of a recording, or the length of an axial one.",
    Field{"file", &FittedRecording::file}, Field{"index", &FittedRecording::index, "within the file"},
    Field{"kind", in(&FittedRecording::recording, &Recording::kind), "circle, axial"},
    Field{"readings", count(in(&FittedRecording::recording, &Recording::length_mm))},
    Field{"nominal_length_mm", known(in(&FittedRecording::recording, &Recording::nominal_length_mm))},
    Field{"length_mm", of_axial(&AxialLength::length_mm), "of an axial one"},
    Field{"sigma_length_um", of_axial(&AxialLength::sigma_um)},
    Field{"plane", if_circle(&FittedRecording::recording, &Recording::plane),
          "XY, YZ, ZX; this and what follows of a circle"},
    Field{"direction", if_circle(&FittedRecording::recording, &Recording::direction), "CCW, CW"},
    Field{"arc_deg", of_circle(&Circle::arc_deg)}, Field{"model", of_circle(&Circle::model), "length_equation, polar"},
    Field{"centre_a_um", of_circle(&Circle::centre_a_um)}, Field{"centre_b_um", of_circle(&Circle::centre_b_um)},
    Field{"radius_mm", of_circle(&Circle::radius_mm)},
    Field{"circularity_um", of_roundness(&Circularity::circular_deviation_um), "largest minus smallest deviation"},
    Field{"feed_mm_per_min", may_lack(in(&FittedRecording::recording, &Recording::feed_mm_per_min)),
          "where it is known"},
    Field{"rms_um", [](const FittedRecording& of) { return of.axial ? of.axial->rms_um : of.circle->rms_um; },
          "of the residual"},
    Field{"sigma_centre_a_um", of_circle(&Circle::sigma_centre_a_um)},
    Field{"sigma_centre_b_um", of_circle(&Circle::sigma_centre_b_um)},
    Field{"sigma_radius_um", of_circle(&Circle::sigma_radius_um)},
    Field{"sigma_circularity_um", of_roundness(&Circularity::circular_deviation_sigma_um)},
    Field{"correlation_a_b", of_circle(&Circle::correlation_a_b)},
    Field{"correlation_a_radius", of_circle(&Circle::correlation_a_radius)},
    Field{"correlation_b_radius", of_circle(&Circle::correlation_b_radius)},
    Field{"sigma_reading_um", of_circle(&Circle::sigma_reading_um)},
    Field{"autocorrelation", of_circle(&Circle::autocorrelation), "of the residual"},
    Field{"effective_readings", of_circle(&Circle::effective_readings), "equivalent number of independent readings"},
    Field{"max_circular_um", of_roundness(&Circularity::max_circular_um), "the largest deviation"},
    Field{"max_at_deg", of_roundness(&Circularity::max_at_deg)},
    Field{"min_circular_um", of_roundness(&Circularity::min_circular_um), "the smallest"},
    Field{"min_at_deg", of_roundness(&Circularity::min_at_deg)},
    Field{"converged", of_circle(&Circle::converged), "whether the fit came to an end"},
    Field{"discounted", of_circle(&Circle::discounted), "readings, with --robust"},
    Field{"stored", may_lack(in(&FittedRecording::results, &stored_results)), "what the file stores of these"});

template <>
inline constexpr auto kResult<SkippedFile> = ResultType("SkippedFile", "A file that could not be read.",
                                                        Field{"file", &SkippedFile::file},
                                                        Field{"why", &SkippedFile::why,
                                                              "a sentence with the file's name"});

KeysOf<double> keys_of(const std::vector<Compared>& results);

template <>
inline constexpr auto kResult<FittedPair> = ResultType(
    "FittedPair", "The numbers of ISO 230-4 of both directions.",
    Field{"file", may_lack(&FittedPair::file), "of several pairs: of its first"},
    Field{"RESULT", in(&FittedPair::results, &keys_of), "g_ccw_um, g_cw_um, bidirectional_2005_um, d_um, h_um, ..."},
    Field{"stored", may_lack(in(&FittedPair::results, &stored_results)), "what the file stores of these"},
    Field{"remarks", may_lack(&FittedPair::remarks)});

template <>
inline constexpr auto kResult<StoredValue> = ResultType(
    "ValueAlone", "A value that a file stores.", Field{"of", &StoredValue::of, "run, with its direction, or analysis"},
    Field{"name", &StoredValue::name, "as the file has it"}, Field{"value", &StoredValue::value},
    Field{"unit", &StoredValue::unit});

template <>
inline constexpr auto kResult<ResultsAlone> = ResultType("ResultsAlone", "A file that stores results without readings.",
                                                         Field{"file", &ResultsAlone::file},
                                                         Field{"stored", &ResultsAlone::stored});

// The only pair, without its file; and several.
std::optional<FittedPair> only_pair(const std::vector<FittedPair>& pairs);
std::vector<FittedPair> several_pairs(const std::vector<FittedPair>& pairs);

inline constexpr FieldList kPairFields{
    Field{"iso230_4", may_lack(&only_pair), "of the only pair of CCW and CW: the numbers of ISO 230-4"},
    Field{"iso230_4_pairs", may_lack(&several_pairs), "of several pairs, each with its file"}};

template <>
inline constexpr auto kResult<Fitted> = ResultType("Fitted", "The circles of recordings.",
                                                   Field{"recordings", &Fitted::recordings, "one row per recording"},
                                                   Field{"results_alone", may_lack(&Fitted::results_alone),
                                                         "files that store results without readings"},
                                                   fields_of(&Fitted::pairs, kPairFields));

}  // namespace ballbar
