#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "ballbar/drift/compare.hpp"
#include "ballbar/internal/number_text.hpp"
#include "ballbar/units.hpp"

namespace ballbar {
namespace {

// From when to when its samples deviate, and by how much.
std::string stretch_of(const AxisComparison& axis) {
  const Deviation& deviation = *axis.deviation;
  std::string when;
  if (deviation.from_s == deviation.to_s && !deviation.to_the_end) {
    when = fmt::format("at {:g} min", min_from_s(deviation.from_s));
  } else {
    when = fmt::format("from {:g} min to {}", min_from_s(deviation.from_s),
                       deviation.to_the_end ? "the end" : fmt::format("{:g} min", min_from_s(deviation.to_s)));
  }
  return fmt::format("{} {}, by {:.2f} ± {:.2f} {} at {:g} min", axis.name, when, deviation.largest, deviation.sigma,
                     axis.unit, min_from_s(deviation.at_s));
}

// Two digits of sigma: "4.03 ± 0.81".
std::string with_two_digits(double value, double sigma) {
  const int decimals = decimals_showing(2, sigma);
  return fmt::format("{:.{}f} ± {:.{}f}", value, decimals, sigma, decimals);
}

// In s below 90 s, else in min.
std::string time_text(double time_s, double sigma_s) {
  constexpr double kLongest_s = 90.0;
  if (time_s < kLongest_s) return fmt::format("{} s", with_two_digits(time_s, sigma_s));
  return fmt::format("{} min", with_two_digits(min_from_s(time_s), min_from_s(sigma_s)));
}

std::string amount_of(DifferenceKind kind, const DifferencePart& part, const std::string& unit) {
  switch (kind) {
    case DifferenceKind::offset:
      return fmt::format("{} {}", with_two_digits(std::abs(part.value), part.sigma), unit);
    case DifferenceKind::gain:
      return fmt::format("{} %", with_two_digits(100.0 * std::abs(part.value - 1.0), 100.0 * part.sigma));
    case DifferenceKind::lag:
      return time_text(std::abs(part.value), part.sigma);
    case DifferenceKind::drift:
      return fmt::format("{} {}/h", with_two_digits(std::abs(part.value), part.sigma), unit);
  }
  return {};
}

std::string sentence_of(DifferenceKind kind, const DifferencePart& part, const AxisComparison& axis) {
  const std::string amount = amount_of(kind, part, axis.unit);
  switch (kind) {
    case DifferenceKind::offset:
      return fmt::format("{} of B is {} {} A from the first sample on. Check the reference point.", axis.name, amount,
                         part.value > 0.0 ? "above" : "below");
    case DifferenceKind::gain:
      return fmt::format("{} of B is {} {} than A. Check the scale, the bar length and the place along the spindle.",
                         axis.name, amount, part.value > 1.0 ? "larger" : "smaller");
    case DifferenceKind::lag:
      return fmt::format("{} of {} is {} late. Check the clocks.", axis.name, part.value > 0.0 ? "A" : "B", amount);
    case DifferenceKind::drift:
      return fmt::format("{} of B drifts {} from A by {}. Check the stand and the fixture for creep.", axis.name,
                         part.value > 0.0 ? "up" : "down", amount);
  }
  return {};
}

constexpr const char* kNames[] = {"an offset", "a scale error", "a clock error", "a steady drift"};

// The significant parts, the largest first.
std::string sentences_of_structure(const AxisComparison& axis) {
  if (!axis.structure || !axis.structure->stands_out) return {};
  const DifferenceStructure& structure = *axis.structure;
  const std::vector<DifferenceKind> alone = sufficient_alone(structure);
  const auto part_of = [](const DifferenceParts& parts, DifferenceKind kind) -> const std::optional<DifferencePart>& {
    return parts[static_cast<std::size_t>(kind)];
  };
  std::vector<DifferenceKind> named;
  for (const DifferenceKind kind : kDifferenceKinds) {
    if (part_of(structure.parts, kind) && part_of(structure.parts, kind)->named) named.push_back(kind);
  }
  std::stable_sort(named.begin(), named.end(), [&](DifferenceKind a, DifferenceKind b) {
    return part_of(structure.parts, a)->explains > part_of(structure.parts, b)->explains;
  });
  std::vector<std::string> sentences;
  if (alone.size() == 1) {
    // One thing that explains all of it, and none of the others does: more exact than with the others free.
    sentences.push_back(sentence_of(alone.front(), *part_of(structure.alone, alone.front()), axis));
  } else if (!named.empty()) {
    for (const DifferenceKind kind : named)
      sentences.push_back(sentence_of(kind, *part_of(structure.parts, kind), axis));
  } else if (!alone.empty()) {
    std::vector<std::string> either;
    either.reserve(alone.size());
    for (const DifferenceKind kind : alone) {
      either.push_back(fmt::format("{} ({})", kNames[static_cast<std::size_t>(kind)],
                                   amount_of(kind, *part_of(structure.alone, kind), axis.unit)));
    }
    sentences.push_back(
        fmt::format("{} of A and B differs by more than the uncertainty. One of these explains it: {}. "
                    "The samples cannot show which.",
                    axis.name, fmt::join(either, ", ")));
  } else {
    sentences.push_back(
        fmt::format("{} of A and B differs by more than the uncertainty. No scale, clock, offset or "
                    "steady drift alone explains it.",
                    axis.name));
  }
  if (structure.noise == NoiseOfDifference::from_rows) {
    sentences.push_back(
        fmt::format("The uncertainty of {} is not stated; its noise is estimated from the samples.", axis.name));
  }
  return fmt::format("{}", fmt::join(sentences, " "));
}

struct CommonLag {
  double lag_s = 0.0, sigma_s = 0.0;  // positive: A is late
  std::vector<std::string> axes;      // that have a lag
};

// One clock that is late: the lags of best agreement of two axes or more, which are the same within 3 sigma and not 0,
// where some axis disagrees. An axis that a scale explains better has no lag.
std::optional<CommonLag> common_lag(const Comparison& comparison) {
  constexpr double kMostSigmas = 3.0;
  const auto alone = [](const AxisComparison& axis, DifferenceKind kind) {
    return axis.structure ? axis.structure->alone[static_cast<std::size_t>(kind)] : std::nullopt;
  };
  CommonLag common;
  double weight = 0.0;
  bool stands_out = false;
  for (const AxisComparison& axis : comparison.axes) {
    stands_out = stands_out || (axis.structure && axis.structure->stands_out);
    if (!axis.lag_s || !(*axis.lag_sigma_s > 0.0)) continue;
    const auto gain = alone(axis, DifferenceKind::gain), lag = alone(axis, DifferenceKind::lag);
    if (gain && gain->named && (!lag || lag->explains < gain->explains)) return std::nullopt;
    const double of_axis = 1.0 / (*axis.lag_sigma_s * *axis.lag_sigma_s);
    common.lag_s += of_axis * *axis.lag_s;
    weight += of_axis;
    common.axes.push_back(axis.name);
  }
  if (!stands_out || common.axes.size() < 2) return std::nullopt;
  common.lag_s /= weight;
  common.sigma_s = 1.0 / std::sqrt(weight);
  const bool same = std::all_of(comparison.axes.begin(), comparison.axes.end(), [&](const AxisComparison& axis) {
    return !axis.lag_s || std::abs(*axis.lag_s - common.lag_s) <= kMostSigmas * *axis.lag_sigma_s;
  });
  return same && std::abs(common.lag_s) > kMostSigmas * common.sigma_s ? std::optional(common) : std::nullopt;
}

}  // namespace

std::string conclusion(const Comparison& comparison) {
  std::vector<std::string> sentences, agree, unknown, deviations;
  const std::optional<CommonLag> lag = common_lag(comparison);
  if (lag) {
    const bool on_all = lag->axes.size() == comparison.axes.size();
    sentences.push_back(fmt::format("{} is {} late on {}. Check the clocks.", lag->lag_s > 0.0 ? "A" : "B",
                                    time_text(std::abs(lag->lag_s), lag->sigma_s),
                                    on_all ? "every axis" : fmt::format("{}", fmt::join(lag->axes, ", "))));
  }
  for (const AxisComparison& axis : comparison.axes) {
    std::string text = lag ? std::string() : sentences_of_structure(axis);
    if (!text.empty()) sentences.push_back(std::move(text));
    if (axis.agreement == Agreement::agrees) agree.push_back(axis.name);
    if (axis.agreement == Agreement::cannot_tell) unknown.push_back(axis.name);
    if (!axis.samples_agree && axis.deviation) deviations.push_back(stretch_of(axis));
  }
  const char* s = agree.size() == 1 ? "s" : "";
  if (!deviations.empty()) {
    sentences.push_back(fmt::format("Beyond the stated uncertainty: {}.", fmt::join(deviations, "; ")));
  }
  if (!agree.empty()) {
    sentences.push_back(fmt::format("{} agree{}{}.", fmt::join(agree, ", "), s,
                                    sentences.empty() ? " within the stated uncertainty" : ""));
  }
  if (!unknown.empty()) {
    sentences.push_back(
        fmt::format("{}: agreement unknown, because no uncertainty is stated.", fmt::join(unknown, ", ")));
  }
  return fmt::format("{}", fmt::join(sentences, " "));
}

}  // namespace ballbar
