#include <cmath>

#include "effects/evaluate.hpp"
#include "effects/recording_rows.hpp"

namespace ballbar::catalogue {
namespace {

// An error k (4 x^3 - 3 x) of axis A along itself, x = cos theta its position over R, is k cos 3 theta, and along the
// bar
//
//   k cos 3 theta cos theta = (k / 2) (cos 4 theta + cos 2 theta);
//
// of B - (k / 2) (cos 2 theta - cos 4 theta); across the axes the same with sines. The second harmonic is that of scale
// and squareness and is left to them; the fourth is the sum of both axes'.
struct CubicError {
  template <class T>
  T operator()(const EffectRows& rows, std::size_t i, const T* p, T*) const {
    const std::span<const double> angle_rad = rows.inputs[0];
    return p[0] * (0.5 * std::cos(4.0 * angle_rad[i])) + p[1] * (0.5 * std::sin(4.0 * angle_rad[i]));
  }
};

}  // namespace

extern const Effect kCubicError{
    "cubic_error",
    Level::recording,
    {.summary = "The error of an axis is cubic along its travel: pitch varies from middle to ends, or the guideway is "
                "S-shaped.",
     .cause = "A screw or scale with uneven error along the travel, an outdated error table, or an S-shaped guideway.",
     .formula = "(along / 2) cos 4 theta + (across / 2) sin 4 theta",
     .signature = "Four lobes per turn, equal in both directions and at every feed.",
     .on_parts = "An interpolated circle has four lobes, sqrt(along^2 + across^2) high at the radius of the bar and "
                 "less at smaller ones. Bored and drilled holes stay round, but their spacing varies from the middle "
                 "of the travel to its ends, or their row is S-shaped.",
     .confused_with = {"sin_4_theta", "scale_mismatch", "lobing", "straightness_a", "straightness_b"},
     .separated_by = "A circle cannot show which of the two axes has the error. Use a shorter bar at several places, "
                     "or a laser along each axis.",
     .remedy = "Measure both axes along their travel and renew the table of pitch errors; check their straightness.",
     .validity = "Linear axes; the sum of both, that of each over half its travel from end to end.",
     .source = "Kinematics as written; found as a residual of measured .b5r files, equal in both directions."},
    {angle_input()},
    {gain_within("along_um", "um", 1000.0, "peak to peak of the errors along both axes", "along"),
     gain_within("across_um", "um", 1000.0, "peak to peak of the errors across them", "across")},
    by_reading<2>(CubicError{}),
    false,
    {Motion::linear_axes},
    {.error_fit = ErrorFit::where_it_shows},
};

}  // namespace ballbar::catalogue
