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

template <>
inline constexpr auto kResult<DifferencePart> =
    ResultType("DifferencePart", "A part of a difference: offset, gain, lag or drift.",
               Field{"value", with_unit(&DifferencePart::value), "a gain has no unit: 1 is none"},
               Field{"sigma", with_unit(&DifferencePart::sigma)},
               Field{"chance", &DifferencePart::chance, "probability of as much without a cause"},
               Field{"named", &DifferencePart::named, "whether that is below the limit"});

template <DifferenceKind kind>
const std::optional<DifferencePart>& part_of(const DifferenceParts& of) {
  return of[static_cast<std::size_t>(kind)];
}

template <>
inline constexpr auto kResult<DifferenceParts> =
    ResultType("DifferenceParts", "The parts of a difference; null: not determined.",
               Field{"offset", &part_of<DifferenceKind::offset>}, Field{"gain", &part_of<DifferenceKind::gain>},
               Field{"lag", &part_of<DifferenceKind::lag>, "positive: A is late"},
               Field{"drift", &part_of<DifferenceKind::drift>});

template <>
inline constexpr auto kResult<ChiSquare> =
    ResultType("ChiSquare", "Squares of a difference in units of its scatter, summed up.",
               Field{"chi2", &ChiSquare::chi2}, Field{"freedom", &ChiSquare::freedom, "degrees of it"},
               Field{"chance", may_lack(&ChiSquare::chance), "probability of as much without a cause"},
               Field{"limit", may_lack(&ChiSquare::limit), "below which that counts"});

template <NoiseOfDifference noise>
bool is_noise(const DifferenceStructure& of) {
  return of.noise == noise;
}

template <>
inline constexpr auto kResult<DifferenceStructure> = ResultType(
    "DifferenceStructure", "Offset, gain, lag and drift of a difference.",
    Field{"stands_out", &DifferenceStructure::stands_out, "one of the four is named, or all together stand out"},
    Field{"parts", &DifferenceStructure::parts, "each with the other three free"},
    Field{"alone", &DifferenceStructure::alone, "each with the other three none"},
    Field{"sufficient_alone", &sufficient_alone, "those which alone explain all that the four explain"},
    Field{"limit_of_part", &DifferenceStructure::limit_of_part, "the chance below which a part is named"},
    Field{"together", &DifferenceStructure::together, "of the four; the limit is that of `alone`, too"},
    Field{"whole", &DifferenceStructure::whole, "of the whole difference, with the zero's error in common"},
    Field{"noise", &DifferenceStructure::noise, "stated, widened, from rows"},
    Field{"widened_by", where(&is_noise<NoiseOfDifference::widened>, &DifferenceStructure::widened_by),
          "of widened noise"},
    Field{"noise", with_unit(where(&is_noise<NoiseOfDifference::from_rows>, &DifferenceStructure::widened_by)),
          "of noise from rows: sigma of a difference"});

template <>
inline constexpr auto kResult<Deviation> = ResultType(
    "Deviation", "The worst stretch beyond 2 sigma.", Field{"from_s", known(&Deviation::from_s)},
    Field{"to_s", known(&Deviation::to_s)}, Field{"to_the_end", &Deviation::to_the_end},
    Field{"largest", with_unit(&Deviation::largest), "the worst difference there"},
    Field{"sigma", with_unit(&Deviation::sigma), "of that one"}, Field{"at_s", &Deviation::at_s, "where it is"});

template <>
inline constexpr auto kResult<UncertaintyShare> =
    ResultType("UncertaintyShare", "A source of uncertainty.", Field{"source", &UncertaintyShare::source},
               Field{"sigma", with_unit(&UncertaintyShare::sigma), "null: not known"},
               Field{"share", &UncertaintyShare::variance, "of the variance"});

struct ComparedSample {
  double time_s = 0.0, a = 0.0, b = 0.0, difference = 0.0, sigma = 0.0;
  std::string unit;
};

inline std::vector<ComparedSample> samples_of(const AxisComparison& axis) {
  std::vector<ComparedSample> samples;
  for (std::size_t i = 0; i < axis.time_s.size(); ++i)
    samples.push_back({axis.time_s[i], axis.a[i], axis.b[i], axis.difference[i], axis.sigma[i], axis.unit});
  return samples;
}

template <>
inline constexpr auto kResult<ComparedSample> =
    ResultType("ComparedSample", "Both drifts at a common time.", Field{"time_s", known(&ComparedSample::time_s)},
               Field{"a", with_unit(&ComparedSample::a)}, Field{"b", with_unit(&ComparedSample::b)},
               Field{"difference", with_unit(&ComparedSample::difference), "b minus a"},
               Field{"sigma", with_unit(&ComparedSample::sigma), "null: not known"});

template <>
inline constexpr auto kResult<AxisComparison> = ResultType(
    "ComparedAxis", "How two drifts agree along an axis.",
    Field{"agreement", &AxisComparison::agreement, "agrees, disagrees, cannot tell"},
    Field{"mean_relative_deviation", &AxisComparison::mean_relative_deviation, "null: the second does not move"},
    Field{"expected_relative_deviation", &AxisComparison::expected_relative_deviation, "by the stated sigmas"},
    Field{"explained_share", &AxisComparison::explained_share, "of the first by the second"},
    Field{"range_normalised_mean_deviation", &AxisComparison::range_deviation},
    Field{"rmse", with_unit(&AxisComparison::rmse), "of the differences"},
    Field{"max", with_unit(&AxisComparison::largest), "the largest difference"},
    Field{"max_at_s", &AxisComparison::largest_s, "where it is"},
    Field{"bias", with_unit(&AxisComparison::bias), "mean difference"},
    Field{"loa_low", with_unit(&AxisComparison::limit_low), "limits of agreement"},
    Field{"loa_high", with_unit(&AxisComparison::limit_high)},
    Field{"within_2_sigma", &AxisComparison::within, "samples that agree"},
    Field{"samples", &AxisComparison::counted, "with a known sigma, the reference left out"},
    Field{"correlation", &AxisComparison::correlation},
    Field{"lag_s", &AxisComparison::lag_s, "null: none within a quarter of the common time, or no bend"},
    Field{"lag_sigma_s", &AxisComparison::lag_sigma_s},
    Field{"deviation", may_lack(&AxisComparison::deviation), "where some sample is beyond 2 sigma"},
    Field{"structure", &AxisComparison::structure, "its offset, gain, lag and drift; null: too few samples"},
    Field{"budget", &AxisComparison::budget, "where the uncertainty is from"},
    Field{"points", &samples_of, "one row per sample"});

inline TableOf<AxisComparison> axes_by_name(const Comparison& of) {
  TableOf<AxisComparison> axes;
  for (const AxisComparison& axis : of.axes) axes.emplace_back(axis.name, axis);
  return axes;
}

template <>
inline constexpr auto kResult<Comparison> =
    ResultType("Comparison", "How two drifts agree.",
               Field{"conclusion", [](const Comparison& of) { return conclusion(of); }, "what it says in plain words"},
               Field{"a", &Comparison::a, "name of the first"}, Field{"b", &Comparison::b, "name of the second"},
               Field{"reference_s", known(&Comparison::reference_s), "time that both are taken to"},
               Field{"samples", &Comparison::samples, "common times"},
               Field{"left_out", &Comparison::left_out, "times of one alone"},
               Field{"axes", &axes_by_name, "by name: rmse, bias, correlation, chi^2 and the series of the difference"},
               Field{"remarks", &Comparison::remarks});

}  // namespace ballbar
