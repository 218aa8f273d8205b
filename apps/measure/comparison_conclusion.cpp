#include "measure/comparison_conclusion.hpp"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "ballbar/internal/number_text.hpp"
#include "ballbar/message_catalogue.hpp"
#include "ballbar/units.hpp"

namespace ballbar {
namespace {

std::string minutes(double time_s) { return fmt::format("{:g}", min_from_s(time_s)); }

// From when to when its samples deviate, and by how much.
Message stretch_of(const AxisComparison& axis) {
  const Deviation& deviation = *axis.deviation;
  const std::string amount = fmt::format("{:.2f} ± {:.2f} {}", deviation.largest, deviation.sigma, axis.unit);
  const std::string from = minutes(deviation.from_s), largest = minutes(deviation.at_s);
  if (deviation.to_the_end) return messages::deviation_to_the_end(axis.name, from, amount, largest);
  if (deviation.from_s == deviation.to_s) return messages::deviation_at(axis.name, from, amount, largest);
  return messages::deviation_from_to(axis.name, from, minutes(deviation.to_s), amount, largest);
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

Message sentence_of(DifferenceKind kind, const DifferencePart& part, const AxisComparison& axis) {
  const std::string amount = amount_of(kind, part, axis.unit);
  switch (kind) {
    case DifferenceKind::offset:
      return part.value > 0.0 ? messages::compared_offset_above(axis.name, amount)
                              : messages::compared_offset_below(axis.name, amount);
    case DifferenceKind::gain:
      return part.value > 1.0 ? messages::compared_larger(axis.name, amount)
                              : messages::compared_smaller(axis.name, amount);
    case DifferenceKind::lag:
      return messages::compared_late(axis.name, part.value > 0.0 ? "A" : "B", amount);
    case DifferenceKind::drift:
      break;
  }
  return part.value > 0.0 ? messages::compared_drifts_up(axis.name, amount)
                          : messages::compared_drifts_down(axis.name, amount);
}

Message cause_of(DifferenceKind kind, const DifferencePart& part, const AxisComparison& axis) {
  const std::string amount = amount_of(kind, part, axis.unit);
  switch (kind) {
    case DifferenceKind::offset:
      return messages::cause_offset(amount);
    case DifferenceKind::gain:
      return messages::cause_scale(amount);
    case DifferenceKind::lag:
      return messages::cause_clock(amount);
    case DifferenceKind::drift:
      break;
  }
  return messages::cause_drift(amount);
}

// The significant parts, the largest first.
Paragraph structure_of(const AxisComparison& axis) {
  Paragraph text;
  if (!axis.structure || !axis.structure->stands_out) return text;
  const DifferenceStructure& structure = *axis.structure;
  const std::vector<DifferenceKind> alone = sufficient_alone(structure), named = named_differences(structure);
  const auto part_of = [](const DifferenceParts& parts, DifferenceKind kind) -> const DifferencePart& {
    return *parts[static_cast<std::size_t>(kind)];
  };
  if (alone.size() == 1) {
    // One thing that explains all of it, and none of the others does: more exact than with the others free.
    text += sentence_of(alone.front(), part_of(structure.alone, alone.front()), axis);
  } else if (!named.empty()) {
    for (const DifferenceKind kind : named) text += sentence_of(kind, part_of(structure.parts, kind), axis);
  } else if (!alone.empty()) {
    std::vector<MessageValue> either;
    either.reserve(alone.size());
    for (const DifferenceKind kind : alone) either.emplace_back(cause_of(kind, part_of(structure.alone, kind), axis));
    text += messages::compared_either(axis.name, listed(either));
  } else {
    text += messages::compared_unexplained(axis.name);
  }
  if (structure.noise == NoiseOfDifference::from_rows) text += messages::compared_noise_estimated(axis.name);
  return text;
}

}  // namespace

Paragraph conclusion(const Comparison& comparison) {
  Paragraph text;
  std::vector<MessageValue> agree, unknown, deviations;
  const std::optional<CommonLag> lag = common_lag(comparison);
  if (lag) {
    const bool on_all = lag->axes.size() == comparison.axes.size();
    text += messages::compared_clock(lag->lag_s > 0.0 ? "A" : "B", time_text(std::abs(lag->lag_s), lag->sigma_s),
                                     on_all ? messages::every_axis() : listed({lag->axes.begin(), lag->axes.end()}));
  }
  for (const AxisComparison& axis : comparison.axes) {
    if (!lag) text += structure_of(axis);
    if (axis.agreement == Agreement::agrees) agree.emplace_back(axis.name);
    if (axis.agreement == Agreement::cannot_tell) unknown.emplace_back(axis.name);
    if (!axis.samples_agree && axis.deviation) deviations.emplace_back(stretch_of(axis));
  }
  if (!deviations.empty()) text += messages::compared_beyond(semicolon_list(deviations));
  if (!agree.empty()) {
    text += text.empty() ? messages::compared_agree_within(listed(agree), agree.size())
                         : messages::compared_agree(listed(agree), agree.size());
  }
  if (!unknown.empty()) text += messages::compared_unknown(listed(unknown));
  return text;
}

}  // namespace ballbar
