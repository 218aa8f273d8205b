#include <cmath>

#include "effects/evaluate.hpp"
#include "effects/recording_rows.hpp"

namespace ballbar::catalogue {
namespace {

// - (R / 2) g sin 2 theta, g the angle between +A and +B less a right angle; um/m of mm are nm
struct Squareness {
  template <class T>
  T operator()(const EffectRows& rows, std::size_t i, const T* p, T*) const {
    const std::span<const double> angle_rad = rows.inputs[0], radius_mm = rows.inputs[1];
    return p[0] * (-1e-3 * radius_mm[i] / 2.0 * std::sin(2.0 * angle_rad[i]));
  }
};

}  // namespace

extern const Effect kSquareness{
    "squareness",
    Level::recording,
    {.summary = "The two axes are not at a right angle.",
     .cause = "Misaligned guideways, a bent or settled bed, or a column that leans as it warms.",
     .formula = "- (R / 2) squareness sin 2 theta, positive where the angle from +A to +B is more than 90 deg",
     .signature = "An oval along the diagonals, equal in both directions and at every feed.",
     .on_parts = "An interpolated circle of radius r becomes an oval whose diameters along the two diagonals differ by "
                 "2 r squareness. Bored and drilled holes stay round, but a pattern of holes is sheared and milled "
                 "sides are out of square by that angle: 20 um over 1 m where it is 20 um/m.",
     .confused_with = {"servo_mismatch", "oval", "scale_mismatch"},
     .separated_by = "Measure both directions: a servo mismatch turns its oval with the direction, squareness does "
                     "not. One direction alone cannot separate them.",
     .remedy = "Align the guideways or enter the squareness compensation; check levelling and foundation first.",
     .validity = "Linear axes, only in the area of the test; bent guideways have another angle elsewhere.",
     .source = "Kinematics: b moves A by - g b; sign and size as AF_SQUARENESS of measured .b5r files."},
    {angle_input(), radius_input()},
    {gain_within("squareness_um_per_m", "um/m", 10000.0, "angle from +A to +B minus a right angle")},
    by_reading<1>(Squareness{}),
    false,
    {Motion::linear_axes},
    {.error_fit = ErrorFit::together,
     .damping = {{{1.0}, 61.0, Damping::Where::arcs_on_diagonals}},
     .relation = AxisRelation::angle},
};

}  // namespace ballbar::catalogue
