#include "effects/evaluate.hpp"
#include "effects/recording_rows.hpp"

namespace ballbar::catalogue {
namespace {

// A bow of axis A moves the ball along B by s (a / R)^2: 0 in the middle, s at both ends of the circle. Along the bar
//
//   s cos^2 theta sin theta = (s / 4) (sin theta + sin 3 theta),
//
// and for B s sin^2 theta cos theta = (s / 4) (cos theta - cos 3 theta). The first harmonic is a shift of the centre.
struct Straightness {
  Axis axis;

  template <class T>
  void operator()(const EffectRows& rows, const T* p, T* out) const {
    const std::span<const double> angle_rad = rows.inputs[0];
    for (std::size_t i = 0; i < angle_rad.size(); ++i) {
      const AxisState state = state_of(axis, angle_rad[i], 1.0);
      out[i] = p[0] * (state.position * state.position * state.across);
    }
  }
};

Effect straightness(Axis axis) {
  const bool a = axis == Axis::A;
  return {
      a ? "straightness_a" : "straightness_b",
      Level::recording,
      {.summary = a ? "Axis A runs along a bow, towards B." : "Axis B runs along a bow, towards A.",
       .cause = "A bent guideway: by its own weight, by clamping, by a bed that is warmer on top than below.",
       .formula = "bow (x / R)^2 times the other axis' position over R, x the position of the axis",
       .signature = "Three lobes a turn and a shift of the centre, the same in both directions and at every feed.",
       .confused_with = {"circle", "lobing", a ? "straightness_b" : "straightness_a"},
       .separated_by =
           "A full turn: half an arc cannot tell a bow from the centre. A longer bar shows a bow that grows "
           "with the square of the radius, lobes of the balls do not grow.",
       .remedy = "Level the machine, check clamping and load of the guideways, let the bed's temperature settle.",
       .validity = "Linear axes; a bow of one curvature over the circle.",
       .source = "Kinematics as written; sign and size as AF_STRAIGHTNESS of measured .b5r files."},
      {angle_input()},
      {{"bow_um", "um", ParameterKind::gain, 0.0, -1000.0, 1000.0, {}, "ends of the travel above its middle"}},
      evaluated_by<1>(Straightness{axis}),
      false,
      {Motion::linear_axes},
  };
}

}  // namespace

extern const Effect kStraightnessA = straightness(Axis::A);
extern const Effect kStraightnessB = straightness(Axis::B);

}  // namespace ballbar::catalogue
