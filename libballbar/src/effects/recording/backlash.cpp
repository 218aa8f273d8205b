#include "effects/evaluate.hpp"
#include "effects/recording_rows.hpp"

namespace ballbar::catalogue {
namespace {

// The axis trails its command by half the play: at - (u / 2) sign(v) along the axis, and along the bar that times
// cos theta (A) or sin theta (B). At the reversal the length steps outwards by u.
struct Backlash {
  Axis axis;

  template <class T>
  void operator()(const EffectRows& rows, const T* p, T* out) const {
    const std::span<const double> angle_rad = rows.inputs[0], direction = rows.inputs[1];
    for (std::size_t i = 0; i < angle_rad.size(); ++i) {
      const AxisState state = state_of(axis, angle_rad[i], direction[i]);
      out[i] = p[0] * (-0.5 * state.velocity_sign * state.position);
    }
  }
};

Effect backlash(Axis axis) {
  const bool a = axis == Axis::A;
  return {
      a ? "backlash_a" : "backlash_b",
      Level::recording,
      {.summary = a ? "Play of axis A: a step where A reverses, at 0 and 180 deg."
                    : "Play of axis B: a step where B reverses, at 90 and 270 deg.",
       .cause = "Play in the screw, its nut or its bearing, or a guideway that winds the drive up before it moves. A "
                "positive play is lost motion; a negative one is a compensation that does too much.",
       .formula = "- (play / 2) sign(velocity of the axis) times the axis' position over R",
       .signature = "A step outwards (negative play: inwards) at both reversals of the axis, the same size at every "
                    "feed. The two directions step on opposite sides.",
       .confused_with = {a ? "reversal_spike_a" : "reversal_spike_b", a ? "lateral_play_b" : "lateral_play_a",
                         "servo_mismatch", "centre_drift"},
       .separated_by = "Both directions with a full turn. Two feeds in the order A-B-B-A: a servo mismatch grows with "
                       "the feed, play does not.",
       .remedy = "Adjust or replace nut and bearing; the control's backlash compensation hides it only.",
       .validity = "Linear axes; play that is the same at both ends of the travel. Instrument software stores "
                   "AF_BACKLASH for each end and GLOBAL, their mean, which is this one.",
       .source = "Kinematics of lost motion; sign and size as AF_BACKLASH of measured .b5r files."},
      {angle_input(), direction_input()},
      {{"play_um", "um", ParameterKind::gain, 0.0, -1000.0, 1000.0, {}, "step outwards at a reversal"}},
      evaluated_by<1>(Backlash{axis}),
      false,
      {Motion::linear_axes},
  };
}

}  // namespace

extern const Effect kBacklashA = backlash(Axis::A);
extern const Effect kBacklashB = backlash(Axis::B);

}  // namespace ballbar::catalogue
