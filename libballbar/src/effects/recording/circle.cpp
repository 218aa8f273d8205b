#include <cmath>

#include "effects/evaluate.hpp"
#include "effects/recording_rows.hpp"

namespace ballbar::catalogue {
namespace {

// 1000 (|c + R (cos theta, sin theta) + h n| - L_0), R = L_0 + radius: the length equation of recording.hpp
struct Circle {
  template <class T>
  T operator()(const EffectRows& rows, std::size_t i, const T* p, T*) const {
    using std::sqrt;
    const std::span<const double> angle_rad = rows.inputs[0], radius_mm = rows.inputs[1], height_mm = rows.inputs[2];
    const std::span<const double> recording = rows.inputs[3];
    if (!belongs_to(p[3], recording[i])) return T(0.0);
    const T path_mm = radius_mm[i] + 1e-3 * p[2];
    const T a_mm = 1e-3 * p[0] + path_mm * std::cos(angle_rad[i]);
    const T b_mm = 1e-3 * p[1] + path_mm * std::sin(angle_rad[i]);
    const T square = a_mm * a_mm + b_mm * b_mm + height_mm[i] * height_mm[i];
    // sqrt(square) - L_0 without the loss of digits
    return 1e3 * (square - radius_mm[i] * radius_mm[i]) / (sqrt(square) + radius_mm[i]);
  }
};

}  // namespace

extern const Effect kCircle{
    "circle",
    Level::recording,
    {.summary = "Centre and radius of the path: the base of every model of a recording.",
     .cause = "The centre of the path is not exactly at the fixed ball, and its radius differs from the nominal "
              "length. Set-up and drift move the centre; feed, scale and temperature change the radius.",
     .formula = "|c + R (cos theta, sin theta) + h n| - L0 with c = (centre_a, centre_b) and R = L0 + radius",
     .signature = "One wave a turn for the centre, a constant for the radius.",
     .confused_with = {"straightness_a", "straightness_b", "bar_temperature", "dynamic_contraction"},
     .separated_by = "A full circle determines its centre, a short arc does not. Several recordings with one set-up "
                     "show changes between them.",
     .remedy = "The centre depends on the set-up and is no machine error. For a wrong radius check the scales of both "
               "axes, the feed and the calibration of the bar.",
     .validity = "Exact for any offset and height; `recording` says which recording it belongs to, -1 all of them.",
     .source = "Length equation, exact; recording.hpp."},
    {angle_input(), radius_input(), height_input(), recording_input()},
    {gain_within("centre_a_um", "um", 5000.0, "from the fixed ball to the path's centre"),
     gain_within("centre_b_um", "um", 5000.0, "the same along B"),
     gain_within("radius_um", "um", 5000.0, "path's radius less the nominal length"), recording_parameter()},
    by_reading<4>(Circle{}),
    false,
    {},
    {.is_base = true, .one_for_all = {"radius_um"}},
};

}  // namespace ballbar::catalogue
