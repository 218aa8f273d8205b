// What `compare --json` prints.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/drift/compare.hpp"
#include "ballbar/formats/results/message.hpp"
#include "ballbar/formats/results/result_type.hpp"
#include "measure/comparison_conclusion.hpp"

namespace ballbar {

constexpr std::string_view name_of(DifferenceKind kind) {
  constexpr std::string_view kNames[] = {"offset", "gain", "lag", "drift"};
  return kNames[static_cast<std::size_t>(kind)];
}
constexpr std::string_view name_of(NoiseOfDifference noise) {
  constexpr std::string_view kNames[] = {"stated", "widened", "from rows"};
  return kNames[static_cast<std::size_t>(noise)];
}
constexpr std::string_view name_of(Agreement agreement) {
  constexpr std::string_view kNames[] = {"agrees", "disagrees", "cannot tell"};
  return kNames[static_cast<std::size_t>(agreement)];
}

// A part of a comparison, with the unit of its axis.
template <class Part>
struct InUnit {
  Part part;
  std::string unit;
};
template <class Part, class Value>
constexpr auto of_unit(Value Part::*member) {
  return [member](const InUnit<Part>& of) { return OfUnit<Value>{of.part.*member, of.unit}; };
}
template <class Part, class Value>
constexpr auto plain(Value Part::*member) {
  return [member](const InUnit<Part>& of) { return of.part.*member; };
}

template <class Part>
constexpr auto plain_known(double Part::*member) {
  return [member](const InUnit<Part>& of) { return Known<double>{of.part.*member}; };
}

template <>
inline constexpr auto kResult<InUnit<DifferencePart>> =
    ResultType{"DifferencePart", "A part of a difference: offset, gain, lag or drift.",
               std::tuple{Field{"value", of_unit(&DifferencePart::value), "a gain has no unit: 1 is none"},
                          Field{"sigma", of_unit(&DifferencePart::sigma), ""},
                          Field{"chance", plain(&DifferencePart::chance), "probability of as much without a cause"},
                          Field{"named", plain(&DifferencePart::named), "whether that is below the limit"}}};

// One part of those.
constexpr auto part_of(DifferenceKind kind) {
  return [kind](const InUnit<DifferenceParts>& of) -> std::optional<InUnit<DifferencePart>> {
    const std::optional<DifferencePart>& part = of.part[static_cast<std::size_t>(kind)];
    if (!part) return std::nullopt;
    switch (kind) {
      case DifferenceKind::gain:
        return InUnit<DifferencePart>{*part, ""};
      case DifferenceKind::lag:
        return InUnit<DifferencePart>{*part, "s"};
      case DifferenceKind::drift:
        return InUnit<DifferencePart>{*part, of.unit + "_per_h"};
      default:
        return InUnit<DifferencePart>{*part, of.unit};
    }
  };
}

template <>
inline constexpr auto kResult<InUnit<DifferenceParts>> =
    ResultType{"DifferenceParts", "The parts of a difference; null: not determined.",
               std::tuple{Field{name_of(DifferenceKind::offset), part_of(DifferenceKind::offset), ""},
                          Field{name_of(DifferenceKind::gain), part_of(DifferenceKind::gain), ""},
                          Field{name_of(DifferenceKind::lag), part_of(DifferenceKind::lag), "positive: A is late"},
                          Field{name_of(DifferenceKind::drift), part_of(DifferenceKind::drift), ""}}};

// chi^2 of all parts together, and of the whole difference.
struct PartsTogether {
  double chi2 = 0.0;
  std::size_t freedom = 0;
  MayLack<double> chance, limit;
};

template <>
inline constexpr auto kResult<PartsTogether> = ResultType{
    "ChiSquare", "Squares of a difference in units of its scatter, summed up.",
    std::tuple{Field{"chi2", &PartsTogether::chi2, ""}, Field{"freedom", &PartsTogether::freedom, "degrees of it"},
               Field{"chance", &PartsTogether::chance, "probability of as much without a cause"},
               Field{"limit", &PartsTogether::limit, "below which that counts"}}};

template <>
inline constexpr auto kResult<InUnit<DifferenceStructure>> = ResultType{
    "DifferenceStructure", "Offset, gain, lag and drift of a difference.", std::tuple{
      Field{"stands_out", plain(&DifferenceStructure::stands_out),
            "one of the four is named, or all together stand out"},
      Field{"parts",
            [](const InUnit<DifferenceStructure>& of) {
              return InUnit<DifferenceParts>{of.part.parts, of.unit};
            },
            "each with the other three free"},
      Field{"alone",
            [](const InUnit<DifferenceStructure>& of) {
              return InUnit<DifferenceParts>{of.part.alone, of.unit};
            },
            "each with the other three none"},
      Field{"sufficient_alone", [](const InUnit<DifferenceStructure>& of) { return sufficient_alone(of.part); },
            "those which alone explain all that the four explain"},
      Field{"limit_of_part", plain(&DifferenceStructure::limit_of_part), "the chance below which a part is named"},
      Field{"together",
            [](const InUnit<DifferenceStructure>& of) {
              return PartsTogether{
                  of.part.chi2_of_parts, of.part.parts_freedom, {of.part.chance_of_parts}, {of.part.limit_of_parts}};
            },
            "of the four; the limit is that of `alone`, too"},
      Field{"whole",
            [](const InUnit<DifferenceStructure>& of) {
              return PartsTogether{of.part.chi2, of.part.rows, {}, {}};
            },
            "of the whole difference, with the zero's error in common"},
      Field{"noise", plain(&DifferenceStructure::noise), "stated, widened, from rows"},
      Field{"widened_by",
            [](const InUnit<DifferenceStructure>& of) {
              return MayLack<double>{of.part.noise == NoiseOfDifference::widened ? std::optional(of.part.widened_by)
                                                                                 : std::nullopt};
            },
            "of widened noise"},
      Field{"noise",
            [](const InUnit<DifferenceStructure>& of) {
              return OfUnit<MayLack<double>>{
                  {of.part.noise == NoiseOfDifference::from_rows ? std::optional(of.part.widened_by) : std::nullopt},
                  of.unit};
            },
            "of noise from rows: sigma of a difference"}}};

template <>
inline constexpr auto kResult<InUnit<Deviation>> = ResultType{
    "Deviation", "The worst stretch beyond 2 sigma.",
    std::tuple{Field{"from_s", plain_known(&Deviation::from_s), ""}, Field{"to_s", plain_known(&Deviation::to_s), ""},
               Field{"to_the_end", plain(&Deviation::to_the_end), ""},
               Field{"largest", of_unit(&Deviation::largest), "the worst difference there"},
               Field{"sigma", of_unit(&Deviation::sigma), "of that one"},
               Field{"at_s", plain(&Deviation::at_s), "where it is"}}};

template <>
inline constexpr auto kResult<InUnit<UncertaintyShare>> =
    ResultType{"UncertaintyShare", "A source of uncertainty.",
               std::tuple{Field{"source", plain(&UncertaintyShare::source), ""},
                          Field{"sigma", of_unit(&UncertaintyShare::sigma), "null: not known"},
                          Field{"share", plain(&UncertaintyShare::variance), "of the variance"}}};

struct ComparedSample {
  double time_s = 0.0, a = 0.0, b = 0.0, difference = 0.0, sigma = 0.0;
};

template <>
inline constexpr auto kResult<InUnit<ComparedSample>> =
    ResultType{"ComparedSample", "Both drifts at a common time.",
               std::tuple{Field{"time_s", plain_known(&ComparedSample::time_s), ""},
                          Field{"a", of_unit(&ComparedSample::a), ""}, Field{"b", of_unit(&ComparedSample::b), ""},
                          Field{"difference", of_unit(&ComparedSample::difference), "b minus a"},
                          Field{"sigma", of_unit(&ComparedSample::sigma), "null: not known"}}};

inline std::vector<InUnit<ComparedSample>> samples_of(const AxisComparison& axis) {
  std::vector<InUnit<ComparedSample>> samples;
  for (std::size_t i = 0; i < axis.time_s.size(); ++i)
    samples.push_back({{axis.time_s[i], axis.a[i], axis.b[i], axis.difference[i], axis.sigma[i]}, axis.unit});
  return samples;
}

inline std::vector<InUnit<UncertaintyShare>> budget_of(const AxisComparison& axis) {
  std::vector<InUnit<UncertaintyShare>> budget;
  for (const UncertaintyShare& share : axis.budget) budget.push_back({share, axis.unit});
  return budget;
}
template <class Value>
constexpr auto of_unit(Value AxisComparison::*member) {
  return [member](const AxisComparison& of) { return OfUnit<Value>{of.*member, of.unit}; };
}

template <>
inline constexpr auto kResult<AxisComparison> = ResultType{
    "ComparedAxis", "How two drifts agree along an axis.", std::tuple{
      Field{"agreement", &AxisComparison::agreement, "agrees, disagrees, cannot tell"},
      Field{"mean_relative_deviation", &AxisComparison::mean_relative_deviation, "null: the second does not move"},
      Field{"expected_relative_deviation", &AxisComparison::expected_relative_deviation, "by the stated sigmas"},
      Field{"explained_share", &AxisComparison::explained_share, "of the first by the second"},
      Field{"range_normalised_mean_deviation", &AxisComparison::range_deviation, ""},
      Field{"rmse", of_unit(&AxisComparison::rmse), "of the differences"},
      Field{"max", of_unit(&AxisComparison::largest), "the largest difference"},
      Field{"max_at_s", &AxisComparison::largest_s, "where it is"},
      Field{"bias", of_unit(&AxisComparison::bias), "mean difference"},
      Field{"loa_low", of_unit(&AxisComparison::limit_low), "limits of agreement"},
      Field{"loa_high", of_unit(&AxisComparison::limit_high), ""},
      Field{"within_2_sigma", &AxisComparison::within, "samples that agree"},
      Field{"samples", &AxisComparison::counted, "with a known sigma, the reference left out"},
      Field{"correlation", &AxisComparison::correlation, ""},
      Field{"lag_s", &AxisComparison::lag_s, "null: none within a quarter of the common time, or no bend"},
      Field{"lag_sigma_s", &AxisComparison::lag_sigma_s, ""},
      Field{"deviation",
            [](const AxisComparison& of) {
              return MayLack<InUnit<Deviation>>{of.deviation ? std::optional(InUnit<Deviation>{*of.deviation, of.unit})
                                                             : std::nullopt};
            },
            "where some sample is beyond 2 sigma"},
      Field{"structure",
            [](const AxisComparison& of) {
              return of.structure ? std::optional(InUnit<DifferenceStructure>{*of.structure, of.unit}) : std::nullopt;
            },
            "its offset, gain, lag and drift; null: too few samples"},
      Field{"budget", &budget_of, "where the uncertainty is from"},
      Field{"points", &samples_of, "one row per sample"}}};

template <>
inline constexpr auto kResult<Comparison> = ResultType{
    "Comparison", "How two drifts agree.",
    std::tuple{Field{"conclusion", [](const Comparison& of) { return conclusion(of); }, "what it says in plain words"},
               Field{"a", &Comparison::a, "name of the first"}, Field{"b", &Comparison::b, "name of the second"},
               Field{"reference_s", known(&Comparison::reference_s), "time that both are taken to"},
               Field{"samples", &Comparison::samples, "common times"},
               Field{"left_out", &Comparison::left_out, "times of one alone"},
               Field{"axes",
                     [](const Comparison& of) {
                       TableOf<AxisComparison> axes;
                       for (const AxisComparison& axis : of.axes) axes.emplace_back(axis.name, axis);
                       return axes;
                     },
                     "by name: rmse, bias, correlation, chi^2 and the series of the difference"},
               Field{"remarks", &Comparison::remarks, ""}}};

}  // namespace ballbar
