#include "axis.hpp"

#include <array>
#include <cmath>

namespace ballbar::hal {

Reason reason_of(Hold hold) {
  switch (hold) {
    case Hold::none:
      return Reason::none;
    case Hold::no_value:
      return Reason::no_value;
    case Hold::spike:
      return Reason::spike;
    case Hold::stuck:
      return Reason::stuck;
    case Hold::out_of_range:
      return Reason::out_of_range;
    case Hold::clock_back:
      return Reason::clock_back;
    case Hold::clock_gap:
      return Reason::clock_gap;
    case Hold::model:
      return Reason::model;
  }
  return Reason::model;
}

const char* name_of(Reason reason) {
  constexpr std::array<const char*, 10> kNames{"none",       "no_value",  "spike", "stuck",    "out_of_range",
                                               "clock_back", "clock_gap", "model", "disabled", "control"};
  return kNames[static_cast<std::size_t>(reason)];
}

// Counts in force; nothing where that is not known, or they are more than ours can be.
std::optional<std::int64_t> Axis::read(const Pins& pins) const {
  if (!(std::abs(pins.applied_mm) * 1000.0 <= largest_um_)) return std::nullopt;
  return static_cast<std::int64_t>(std::round(pins.applied_mm / scale_mm()));
}

void Axis::begin_at(std::int64_t counts) {
  Compensator::State state = wanted_.state();
  if (state.counts == counts) return;
  state.counts = counts;
  state.offset_um = static_cast<double>(counts) * resolution_um_;
  wanted_.resume(state, LiveModel::State(wanted_.model().state()));
}

Step Axis::next(double time_s, std::span<const double> values, const Pins& pins) {
  const std::optional<std::int64_t> found = read(pins);
  // A control that has not yet taken the last change up has one row to do so.
  const bool differs = !found || (in_force_ && *found != *in_force_);
  const bool doubt = !found || (differs && !doubted_);
  doubted_ = differs;
  if (!doubt) in_force_ = found;
  if (in_force_) begin_at(*in_force_);
  Step step;
  step.enable = pins.enable && enabled_;
  enabled_ = pins.enable;
  step.offset = wanted_.next(time_s, values);
  step.reason = reason_of(step.offset.hold);
  if (step.reason == Reason::none && !step.enable) step.reason = Reason::disabled;
  if (step.reason == Reason::none && doubt) step.reason = Reason::control;
  if (step.reason == Reason::none) step.change = step.offset.counts - *in_force_;
  if (in_force_) *in_force_ += step.change;
  step.offset.counts = in_force_.value_or(0);
  step.offset.offset_um = static_cast<double>(step.offset.counts) * resolution_um_;
  return step;
}

}  // namespace ballbar::hal
