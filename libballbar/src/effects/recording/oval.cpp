#include <cmath>

#include "effects/evaluate.hpp"
#include "effects/recording_rows.hpp"

namespace ballbar::catalogue {
namespace {

// c cos 2 theta + s sin 2 theta
struct Oval {
  template <class T>
  T operator()(const EffectRows& rows, std::size_t i, const T* p, T*) const {
    const std::span<const double> angle_rad = rows.inputs[0];
    return p[0] * std::cos(2.0 * angle_rad[i]) + p[1] * std::sin(2.0 * angle_rad[i]);
  }
};

}  // namespace

extern const Effect kOval{
    "oval",
    Level::recording,
    {.summary = "The path of a rotary axis or a spindle is an oval.",
     .cause = "The axis is tilted to the test plane, or its bearing or the spindle rotor is out of round.",
     .formula = "cosine cos 2 theta + sine sin 2 theta",
     .signature = "Two lobes per turn at fixed angles, equal in both directions.",
     .confused_with = {"scale_mismatch", "squareness", "lobing"},
     .separated_by = "Turn the part that carries the ball in its mount and repeat: the form of the bearing stays, the "
                     "form of the part turns with it.",
     .remedy = "Align the rotary axis with the linear axes; check the seat and the preload of its bearing.",
     .validity = "Recordings driven by a rotary axis or a spindle. On linear axes scale_mismatch and squareness have "
                 "this form.",
     .source = "Second harmonic of the radius; not from a paper."},
    {angle_input()},
    {gain_within("cosine_um", "um", 1000.0, "half the difference in length along A and B"),
     gain_within("sine_um", "um", 1000.0, "the same along the diagonals")},
    by_reading<2>(Oval{}),
    false,
    {Motion::rotary_axis, Motion::spindle},
};

}  // namespace ballbar::catalogue
