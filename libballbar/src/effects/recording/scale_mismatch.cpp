#include <cmath>

#include "effects/evaluate.hpp"
#include "effects/recording_rows.hpp"

namespace ballbar::catalogue {
namespace {

// (R / 2) (s_a - s_b) cos 2 theta; ppm of mm are nm
struct ScaleMismatch {
  template <class T>
  void operator()(const EffectRows& rows, const T* p, T* out) const {
    const std::span<const double> angle_rad = rows.inputs[0], radius_mm = rows.inputs[1];
    for (std::size_t i = 0; i < angle_rad.size(); ++i) {
      out[i] = p[0] * (1e-3 * radius_mm[i] / 2.0 * std::cos(2.0 * angle_rad[i]));
    }
  }
};

}  // namespace

extern const Effect kScaleMismatch{
    "scale_mismatch",
    Level::recording,
    {.summary = "One axis measures longer than the other.",
     .cause = "A ball screw or a scale that is longer than the other, because it is warmer, worn, stretched or badly "
              "compensated.",
     .formula = "(R / 2) mismatch cos 2 theta, mismatch = s_a - s_b, positive where A travels too far",
     .signature = "An oval along the axes, the same in both directions and at every feed.",
     .confused_with = {"lateral_play_a", "lateral_play_b", "oval", "squareness"},
     .separated_by = "Both directions: play changes sign with the direction, scale does not. Warm up one axis only and "
                     "see whether the oval grows.",
     .remedy = "Pitch compensation or linear scales; check the screw's temperature, stretch and bearing.",
     .validity =
         "Linear axes, first order; about half a turn is needed to tell it from the centre. Instrument software "
         "stores the difference over a diameter: AF_SCALE_MISMATCH = 2 R (s_a - s_b).",
     .source = "Kinematics: a (1 + s_a), b (1 + s_b) in the length equation; signs as AF_SCALE_ERROR_A and _B of "
               "measured .b5r files."},
    {angle_input(), radius_input()},
    {{"mismatch_ppm", "ppm", ParameterKind::gain, 0.0, -10000.0, 10000.0, {}, "scale of A less scale of B"}},
    evaluated_by<1>(ScaleMismatch{}),
    false,
    {Motion::linear_axes},
};

}  // namespace ballbar::catalogue
