#include "effects/evaluate.hpp"
#include "effects/recording_rows.hpp"

namespace ballbar::catalogue {
namespace {

// The axis trails its command by half the play: at - (u / 2) sign(v) along the axis, and along the bar that times
// x = cos theta (A) or sin theta (B). At the reversal the length steps outwards by u. The play goes linearly from one
// end of the travel to the other: u = u_pos (1 + x) / 2 + u_neg (1 - x) / 2. Over the width w after the reversal the
// axis winds up, and sign(v) goes linearly from the old sign to the new one.
struct Backlash {
  Axis axis;

  template <class T>
  T operator()(const EffectRows& rows, std::size_t i, const T* p, T*) const {
    const std::span<const double> angle_rad = rows.inputs[0], direction = rows.inputs[1];
    const AxisState state = state_of(axis, angle_rad[i], direction[i]);
    const Reversal reversal = last_reversal(axis, angle_rad[i], direction[i]);
    const T sign = p[2] > reversal.since_deg
                       ? (reversal.positive_end ? -1.0 : 1.0) * (2.0 * reversal.since_deg / p[2] - 1.0)
                       : T(state.velocity_sign);
    const T step = -0.5 * sign * state.position;
    return p[0] * (0.5 * (1.0 + state.position) * step) + p[1] * (0.5 * (1.0 - state.position) * step);
  }
};

Effect backlash(Axis axis) {
  const bool a = axis == Axis::A;
  return {
      a ? "backlash_a" : "backlash_b",
      Level::recording,
      {.summary = a ? "Play of axis A: a step where A reverses, at 0 and 180 deg."
                    : "Play of axis B: a step where B reverses, at 90 and 270 deg.",
       .cause = "Play in the screw, its nut or its bearing, or a sticking guideway that winds up the drive. Positive "
                "play is lost motion; negative play is overcompensation.",
       .formula =
           "- (play / 2) sign(velocity of the axis) x, x the axis' position over R; play = play_pos (1 + x) / 2 + "
           "play_neg (1 - x) / 2; over width_deg after a reversal, the sign changes linearly",
       .signature = "A step outwards (negative play: inwards) at the reversals of the axis, the same size at every "
                    "feed. The two directions step on opposite sides.",
       .on_parts = a ? "An interpolated circle has a step of the play at 0 and 180 deg: its two halves are shifted "
                       "along A. A bored or drilled hole is off by the play along A where A approaches it from the "
                       "other side than its neighbours."
                     : "An interpolated circle has a step of the play at 90 and 270 deg: its two halves are shifted "
                       "along B. A bored or drilled hole is off by the play along B where B approaches it from the "
                       "other side than its neighbours.",
       .confused_with = {a ? "reversal_spike_a" : "reversal_spike_b", a ? "lateral_play_b" : "lateral_play_a",
                         "servo_mismatch", "centre_drift"},
       .separated_by = "Measure a full circle in both directions at two feeds in the order A-B-B-A: a servo mismatch "
                       "grows with the feed, play does not.",
       .remedy = "Adjust or replace nut and bearing. The control's backlash compensation only hides the play.",
       .validity = "Linear axes; play that changes linearly along the travel.",
       .source = "Kinematics of lost motion; sign and size as AF_BACKLASH of measured .b5r files."},
      {angle_input(), direction_input()},
      {gain_within("play_pos_um", "um", 1000.0, "step outwards at the reversal on the + end", "pos"),
       gain_within("play_neg_um", "um", 1000.0, "step outwards at the reversal on the - end", "neg"),
       {"width_deg", "deg", ParameterKind::shape, 0.0, 0.0, 1.5, {}, "angle over which the play is taken up", true}},
      by_reading<3>(Backlash{axis}),
      false,
      {Motion::linear_axes},
      {.error_fit = ErrorFit::together,
       .reversal_deg = a ? 0.0 : 90.0,
       .damping = {{{0.5, -0.5}, 80.0, Damping::Where::arcs}}},
  };
}

}  // namespace

extern const Effect kBacklashA = backlash(Axis::A);
extern const Effect kBacklashB = backlash(Axis::B);

}  // namespace ballbar::catalogue
