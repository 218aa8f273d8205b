#include "hal/axis.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace ballbar::hal {

Reason reason_of(Hold hold) {
  constexpr std::array<Reason, kHoldKinds> kReasons{
      Reason::none,    Reason::no_value,   Reason::spike,     Reason::stuck, Reason::out_of_range,
      Reason::no_time, Reason::clock_back, Reason::clock_gap, Reason::model};  // in the order of Hold
  return kReasons[static_cast<std::size_t>(hold)];
}

const char* name_of(Reason reason) {
  constexpr std::array<const char*, 11> kNames{"none",         "no_value",   "spike",     "stuck",
                                               "out_of_range", "clock_back", "clock_gap", "model",
                                               "no_time",      "disabled",   "control"};
  return kNames[static_cast<std::size_t>(reason)];
}

Axis::Axis(const CompensationLimits& limits)
    : resolution_um_(limits.resolution_um),
      largest_um_(limits.largest_um),
      most_counts_(whole_increments(limits.largest_um, limits.resolution_um)) {}

// Counts in force; nothing where that is not known, or they are more than ours can be. Compared as whole counts: the
// control adds changes up, and 2000 times 0.0001 mm is more than 0.2 mm to a double.
std::optional<std::int64_t> Axis::read(const Pins& pins) const {
  const double counts = std::round(pins.applied_mm / scale_mm());
  if (!(std::abs(counts) <= most_counts_)) return std::nullopt;
  return static_cast<std::int64_t>(counts);
}

void Axis::resume_in_force(Compensator& compensator) const {
  if (!in_force_ || compensator.state().counts == *in_force_) return;
  Compensator::State state = compensator.state();
  state.counts = *in_force_;
  // The largest of the counts times the resolution may be above the largest offset by a rounding, as 3 times 0.1 um is
  // above 0.3 um; resume() refuses what is above.
  state.offset_um = std::clamp(static_cast<double>(*in_force_) * resolution_um_, -largest_um_, largest_um_);
  compensator.resume(state, LiveModel::State(compensator.model().state()));
}

void Axis::begin(const Pins& pins, Compensator& compensator) {
  const std::optional<std::int64_t> found = read(pins);
  // A control that has not yet taken the last change up has one row to do so.
  const bool differs = !found || (in_force_ && *found != *in_force_);
  doubt_ = !found || (differs && !doubted_);
  doubted_ = differs;
  if (!doubt_) in_force_ = found;
  enable_ = pins.enable && enabled_;
  enabled_ = pins.enable;
  resume_in_force(compensator);
}

Step Axis::end(const Offset& offset, Compensator& compensator) {
  Step step{.enable = enable_, .offset = offset, .reason = reason_of(offset.hold)};
  if (step.reason == Reason::none && !enable_) step.reason = Reason::disabled;
  if (step.reason == Reason::none && doubt_) step.reason = Reason::control;
  if (step.reason == Reason::none) step.change = offset.counts - *in_force_;
  if (in_force_) *in_force_ += step.change;
  resume_in_force(compensator);
  step.offset.counts = in_force_.value_or(0);
  step.offset.offset_um = static_cast<double>(step.offset.counts) * resolution_um_;
  return step;
}

}  // namespace ballbar::hal
