#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "ballbar/drift/comparison.hpp"
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
  const int decimals = sigma > 0.0 ? std::clamp(1 - static_cast<int>(std::floor(std::log10(sigma))), 0, 6) : 2;
  return fmt::format("{:.{}f} ± {:.{}f}", value, decimals, sigma, decimals);
}

std::string amount_of(DifferenceKind kind, const DifferencePart& part, const std::string& unit) {
  switch (kind) {
    case DifferenceKind::offset:
      return fmt::format("{} {}", with_two_digits(std::abs(part.value), part.sigma), unit);
    case DifferenceKind::gain:
      return fmt::format("{} %", with_two_digits(100.0 * std::abs(part.value - 1.0), 100.0 * part.sigma));
    case DifferenceKind::lag:
      return fmt::format("{} s", with_two_digits(std::abs(part.value), part.sigma));
    case DifferenceKind::drift:
      return fmt::format("{} {}/h", with_two_digits(std::abs(part.value), part.sigma), unit);
  }
  return {};
}

std::string sentence_of(DifferenceKind kind, const DifferencePart& part, const AxisComparison& axis) {
  const std::string amount = amount_of(kind, part, axis.unit);
  switch (kind) {
    case DifferenceKind::offset:
      return fmt::format("{} of B stands {} {} A's from the first sample on: the reference point, or what moved there.",
                         axis.name, amount, part.value > 0.0 ? "above" : "below");
    case DifferenceKind::gain:
      return fmt::format(
          "{} of B is {:.1f} % {} than A's ({}): a wrong scale or bar length, or another place along the spindle.",
          axis.name, 100.0 * std::abs(part.value - 1.0), part.value > 1.0 ? "larger" : "smaller", amount);
    case DifferenceKind::lag:
      return fmt::format("{0} of {1} lags {2}'s by {3}: a clock.", axis.name, part.value > 0.0 ? "A" : "B",
                         part.value > 0.0 ? "B" : "A", amount);
    case DifferenceKind::drift:
      return fmt::format("{} of B moves {} from A's by {}: a stand or a fixture that creeps.", axis.name,
                         part.value > 0.0 ? "up" : "down", amount);
  }
  return {};
}

constexpr const char* kNames[] = {"an offset", "a scale", "a clock", "a steady drift"};

// Empty where nothing stands out. Largest first.
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
        fmt::format("{} of A and B differs by more than both state. Each of these alone would explain it: {}; "
                    "these samples cannot tell which.",
                    axis.name, fmt::join(either, ", ")));
  } else {
    sentences.push_back(
        fmt::format("{} of A and B differs by more than both state; no scale, clock, offset or steady "
                    "drift alone explains it.",
                    axis.name));
  }
  if (structure.noise == NoiseOfDifference::from_rows) {
    sentences.push_back(fmt::format("No uncertainty of {} is stated: its noise was found in the samples.", axis.name));
  }
  return fmt::format("{}", fmt::join(sentences, " "));
}

}  // namespace

std::string conclusion(const Comparison& comparison) {
  std::vector<std::string> sentences, agree, unknown, deviations;
  for (const AxisComparison& axis : comparison.axes) {
    if (std::string text = sentences_of_structure(axis); !text.empty()) sentences.push_back(std::move(text));
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
    sentences.push_back(fmt::format("{}: cannot tell, no uncertainty is known.", fmt::join(unknown, ", ")));
  }
  return fmt::format("{}", fmt::join(sentences, " "));
}

}  // namespace ballbar
