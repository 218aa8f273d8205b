#include <cmath>

#include "effects/evaluate.hpp"
#include "effects/recording_rows.hpp"

namespace ballbar::catalogue {
namespace {

// dir (V / 2) dt sin 2 theta, V in mm/s = um/ms
struct ServoMismatch {
  template <class T>
  T operator()(const EffectRows& rows, std::size_t i, const T* p, T*) const {
    const std::span<const double> angle_rad = rows.inputs[0], direction = rows.inputs[1], feed = rows.inputs[2];
    const double feed_um_per_ms = feed[i] / 60.0;
    return p[0] * (direction[i] * feed_um_per_ms / 2.0 * std::sin(2.0 * angle_rad[i]));
  }
};

}  // namespace

extern const Effect kServoMismatch{
    "servo_mismatch",
    Level::recording,
    {.summary = "One axis follows its command later than the other.",
     .cause = "The position loops of the two axes have different gains or delays.",
     .formula = "dir (V / 2) delay sin 2 theta, delay = delay of A less delay of B",
     .signature = "An oval along the diagonals that turns with the direction and grows with the feed.",
     .on_parts = "An interpolated circle becomes an oval whose diameters along the two diagonals differ by 2 V delay, "
                 "whatever its radius: 3.3 um at 1000 mm/min where the delay is 0.1 ms. Bored and drilled holes are "
                 "free of it, because the axes stand still.",
     .confused_with = {"squareness", "backlash_a", "backlash_b"},
     .separated_by = "Measure both directions and two feeds in the order A-B-B-A: only a servo mismatch changes sign "
                     "with the direction and doubles with the feed.",
     .remedy = "Match the gains of the position loops: raise the gain of the lagging axis or lower the other.",
     .validity = "Linear axes; a delay that is small compared with the time of a turn.",
     .source = "Kinematics: a at t - t_a, b at t - t_b; sign and size as AF_SERVO_MISMATCH of measured .b5r files."},
    {angle_input(), direction_input(), feed_input()},
    {gain_within("delay_ms", "ms", 100.0, "delay of A minus delay of B")},
    by_reading<1>(ServoMismatch{}),
    false,
    {Motion::linear_axes},
    {.error_fit = ErrorFit::together},
};

}  // namespace ballbar::catalogue
