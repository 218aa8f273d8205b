#include <cmath>

#include "effects/evaluate.hpp"
#include "effects/recording_rows.hpp"

namespace ballbar::catalogue {
namespace {

// (m / 4) cos 2 theta, m = 2 R (s_a - s_b)
struct ScaleMismatch {
  template <class T>
  T operator()(const EffectRows& rows, std::size_t i, const T* p, T*) const {
    const std::span<const double> angle_rad = rows.inputs[0];
    return p[0] * (0.25 * std::cos(2.0 * angle_rad[i]));
  }
};

}  // namespace

extern const Effect kScaleMismatch{
    "scale_mismatch",
    Level::recording,
    {.summary = "One axis travels farther than the other.",
     .cause =
         "The ball screw or scale of one axis is longer because it is warmer, worn, stretched or badly compensated.",
     .formula = "(mismatch / 4) cos 2 theta, mismatch = 2 R (s_a - s_b), positive where A travels too far",
     .signature = "An oval along the axes, equal in both directions and at every feed.",
     .on_parts = "An interpolated circle of radius r becomes an oval whose diameters along the two axes differ by "
                 "mismatch r / R. Bored and drilled holes stay round, but their spacing along the two axes differs by "
                 "mismatch / (2 R): 40 ppm where it is 8 um on a bar of 100 mm.",
     .confused_with = {"lateral_play_a", "lateral_play_b", "oval", "squareness"},
     .separated_by = "Measure both directions: play changes sign with the direction, scale does not. Warm up one axis "
                     "alone: a thermal cause makes the oval grow.",
     .remedy =
         "Correct the pitch compensation or use linear scales; check temperature, stretch and bearing of the screw.",
     .validity =
         "Linear axes, first order; separating it from the centre needs about half a turn. The value is the difference "
         "over a diameter, as instrument software stores it; divided by 2 R it is the difference of the scales.",
     .source = "Kinematics: a (1 + s_a), b (1 + s_b) in the length equation; sign and size as AF_SCALE_MISMATCH of "
               "measured .b5r files."},
    {angle_input()},
    {gain_within("mismatch_um", "um", 1000.0, "length of A minus length of B over a diameter")},
    by_reading<1>(ScaleMismatch{}),
    false,
    {Motion::linear_axes},
    {.error_fit = ErrorFit::together,
     .damping = {{{1.0}, 61.0, Damping::Where::arcs_on_axes}},
     .ranked_by_instrument = RankedByInstrument::on_full_turns,
     .relation = AxisRelation::scale},
};

}  // namespace ballbar::catalogue
