#include "effects/evaluate.hpp"
#include "effects/recording_rows.hpp"

namespace ballbar::catalogue {
namespace {

// The slide of one axis is pushed sideways, along the other axis, by + (u / 2) sign(v): along the bar that is
// (u / 2) sign(v_A) sin theta for play of A and (u / 2) sign(v_B) cos theta for play of B. The play goes linearly from
// one end of the travel to the other, as backlash does.
struct LateralPlay {
  Axis axis;

  template <class T>
  T operator()(const EffectRows& rows, std::size_t i, const T* p, T*) const {
    const std::span<const double> angle_rad = rows.inputs[0], direction = rows.inputs[1];
    const AxisState state = state_of(axis, angle_rad[i], direction[i]);
    const double push = 0.5 * state.velocity_sign * state.across;
    return p[0] * (0.5 * (1.0 + state.position) * push) + p[1] * (0.5 * (1.0 - state.position) * push);
  }
};

Effect lateral_play(Axis axis) {
  const bool a = axis == Axis::A;
  return {
      a ? "lateral_play_a" : "lateral_play_b",
      Level::recording,
      {.summary = a ? "Axis A shifts sideways, along B, when it reverses."
                    : "Axis B shifts sideways, along A, when it reverses.",
       .cause = "Play or wear of the guideway: the drive is off-centre, and each reversal pushes the slide to the "
                "other flank.",
       .formula =
           "(play / 2) sign(velocity of the axis) times the other axis' position over R; play = play_pos (1 + x) / 2 "
           "+ play_neg (1 - x) / 2, x the axis' own position over R",
       .signature = "One direction is slightly larger, the other slightly smaller, mostly across the axis. A kink at "
                    "the reversals, equal at every feed.",
       .on_parts = a ? "The diameter along B of an interpolated circle is smaller by the play in one direction and "
                       "larger by the play in the other. A bored or drilled hole is off by the play along B where A "
                       "approaches it from the other side than its neighbours."
                     : "The diameter along A of an interpolated circle is smaller by the play in one direction and "
                       "larger by the play in the other. A bored or drilled hole is off by the play along A where B "
                       "approaches it from the other side than its neighbours.",
       .confused_with = {"scale_mismatch", a ? "lateral_play_b" : "lateral_play_a", "circle",
                         a ? "backlash_b" : "backlash_a"},
       .separated_by = "Measure both directions with one set-up: play changes sign with the direction, scale does not. "
                       "One direction cannot separate play and scale.",
       .remedy = "Adjust gibs or preload of the guideways; check lubrication and wear.",
       .validity = "Linear axes; play that changes linearly along the travel. If every recording has its own radius, "
                   "only the kink identifies it.",
       .source = "Kinematics of a slide between two flanks; size as AF_LATERAL_PLAY of measured .b5r files."},
      {angle_input(), direction_input()},
      {gain_within("play_pos_um", "um", 1000.0, "whole sideways movement when it reverses on the + end", "pos"),
       gain_within("play_neg_um", "um", 1000.0, "whole sideways movement when it reverses on the - end", "neg")},
      by_reading<2>(LateralPlay{axis}),
      false,
      {Motion::linear_axes},
      {.error_fit = ErrorFit::together,
       .reversal_deg = a ? 0.0 : 90.0,
       .damping = {{{0.5, -0.5}, 320.0, Damping::Where::arcs}}},
  };
}

}  // namespace

extern const Effect kLateralPlayA = lateral_play(Axis::A);
extern const Effect kLateralPlayB = lateral_play(Axis::B);

}  // namespace ballbar::catalogue
