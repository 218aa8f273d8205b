#include <cmath>

#include "effects/evaluate.hpp"
#include "effects/recording_rows.hpp"

namespace ballbar::catalogue {
namespace {

// dir (s / 2) sin 4 theta
struct Sin4Theta {
  template <class T>
  T operator()(const EffectRows& rows, std::size_t i, const T* p, T*) const {
    const std::span<const double> angle_rad = rows.inputs[0], direction = rows.inputs[1];
    return p[0] * (0.5 * direction[i] * std::sin(4.0 * angle_rad[i]));
  }
};

}  // namespace

extern const Effect kSin4Theta{
    "sin_4_theta",
    Level::recording,
    {.summary = "The axes follow each other unevenly: four lobes that turn with the direction.",
     .cause = "Delays of the position loops that change with the speed of the axis, such as friction or a feed-forward "
              "that suits one speed only.",
     .formula = "dir (size / 2) sin 4 theta",
     .signature = "Four lobes per turn that change sign with the direction.",
     .on_parts = "An interpolated circle has four lobes of that height, which change place with the direction of "
                 "milling. Bored and drilled holes are free of it, because the axes stand still.",
     .confused_with = {"servo_mismatch", "backlash_a", "backlash_b", "cubic_error"},
     .separated_by = "Measure both directions: lobes that are equal in both are a cubic error of the axes.",
     .remedy = "Tune the position loops of both axes at the feed of the test, including feed-forward and friction "
               "compensation.",
     .validity = "Linear axes. Describes a form that occurs beside the other errors; it is not a cause.",
     .source = "Form, sign and size as AF_SIN_4_THETA of measured .b5r files."},
    {angle_input(), direction_input()},
    {gain_within("size_um", "um", 1000.0, "peak to peak in one direction")},
    by_reading<1>(Sin4Theta{}),
    false,
    {Motion::linear_axes},
    {.error_fit = ErrorFit::together, .ranked_by_instrument = RankedByInstrument::never},
};

}  // namespace ballbar::catalogue
