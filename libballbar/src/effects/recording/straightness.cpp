#include <cmath>

#include "effects/evaluate.hpp"
#include "effects/recording_rows.hpp"

namespace ballbar::catalogue {
namespace {

// A bow of axis A moves the ball along B by s (a / R)^2: 0 in the middle, s at both ends of the circle. Along the bar
//
//   s cos^2 theta sin theta = (s / 4) (sin theta + sin 3 theta),
//
// and for B s sin^2 theta cos theta = (s / 4) (cos theta - cos 3 theta). The first harmonic is a shift of the centre
// and is left to it: what the circle shows of a bow are its three lobes.
struct Straightness {
  Axis axis;

  template <class T>
  T operator()(const EffectRows& rows, std::size_t i, const T* p, T*) const {
    const std::span<const double> angle_rad = rows.inputs[0];
    const double lobes = axis == Axis::A ? std::sin(3.0 * angle_rad[i]) : -std::cos(3.0 * angle_rad[i]);
    return p[0] * (0.25 * lobes);
  }
};

Effect straightness(Axis axis) {
  const bool a = axis == Axis::A;
  return {
      a ? "straightness_a" : "straightness_b",
      Level::recording,
      {.summary = a ? "Axis A moves on a bow, towards B." : "Axis B moves on a bow, towards A.",
       .cause = "A guideway bent by its own weight, by clamping, or by a bed that is warmer on top than below.",
       .formula = a ? "(bow / 4) sin 3 theta" : "- (bow / 4) cos 3 theta",
       .signature = "Three lobes per turn, equal in both directions and at every feed.",
       .on_parts = a ? "An interpolated circle of radius r has three lobes of height (bow / 2) (r / R)^2, which a "
                       "two-point gauge does not show. In a row of bored or drilled holes along A of length 2 R the "
                       "middle is off by the bow along B; a milled side is as hollow or crowned."
                     : "An interpolated circle of radius r has three lobes of height (bow / 2) (r / R)^2, which a "
                       "two-point gauge does not show. In a row of bored or drilled holes along B of length 2 R the "
                       "middle is off by the bow along A; a milled side is as hollow or crowned.",
       .confused_with = {"circle", "lobing", a ? "straightness_b" : "straightness_a"},
       .separated_by = "Measure a full circle: half an arc cannot separate a bow from the centre. With a longer bar a "
                       "bow grows with the square of the radius; lobes of the balls do not.",
       .remedy = "Level the machine; check clamping and load of the guideways; let the bed temperature settle.",
       .validity = "Linear axes; a bow of one curvature over the circle.",
       .source = "Kinematics as written; sign and size as AF_STRAIGHTNESS of measured .b5r files."},
      {angle_input()},
      {gain_within("bow_um", "um", 1000.0, "height of the ends of the travel above its middle")},
      by_reading<1>(Straightness{axis}),
      false,
      {Motion::linear_axes},
      // An arc about +A or -A sees little of cos 3 theta beside the centre, one about B of sin 3 theta.
      {.error_fit = ErrorFit::together,
       .damping = {{{1.0}, 700.0, a ? Damping::Where::arcs_on_b : Damping::Where::arcs_on_a}},
       .ranked_by_instrument = RankedByInstrument::on_full_turns},
  };
}

}  // namespace

extern const Effect kStraightnessA = straightness(Axis::A);
extern const Effect kStraightnessB = straightness(Axis::B);

}  // namespace ballbar::catalogue
