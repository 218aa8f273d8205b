#include <ceres/jet.h>

#include <cmath>

#include "ballbar/units.hpp"
#include "effects/evaluate.hpp"

namespace ballbar::catalogue {
namespace {

// c(dL), um. Where eq. 30 has no value alpha stays at -90 or 90 deg. The paper's table 2 does not follow from it: at
// dL = 20.20 um it gives 4.77 um where the table has 5.14, and the largest difference is 0.81 um, at dL = 9.65 um.
template <class T>
T clearance_um(double elongation_um, const T& ball_diameter_mm, const T& groove_factor) {
  using std::asin;
  using std::tan;
  const T sine =
      std::sin(rad_from_deg(18.0)) - 0.8 * elongation_um / (1000.0 * ball_diameter_mm * (groove_factor - 0.5));
  T alpha_rad(kPi / 2.0);
  if (sine <= T(-1.0)) {
    alpha_rad = T(-kPi / 2.0);
  } else if (sine < T(1.0)) {
    alpha_rad = asin(sine);
  }
  const T theta_rad = (kPi - (rad_from_deg(18.0) - alpha_rad)) / 2.0 - rad_from_deg(72.0);
  return 0.8 * elongation_um * tan(theta_rad);
}

// s c(dL)
struct BearingClearance {
  template <class T>
  T operator()(const EffectRows& rows, std::size_t i, const T* p, T*) const {
    const std::span<const double> axial_um = rows.inputs[0];
    return p[0] * clearance_um(axial_um[i] - axial_um[0], p[1], p[2]);
  }
};

}  // namespace

extern const Effect kBearingClearance{
    "bearing_clearance",
    Level::series,
    {.summary = "Elongation unloads the bearing and opens its clearance.",
     .cause = "The growing rotor pulls the balls of an angular contact bearing along its groove; contact angle and "
              "preload fall and radial clearance opens.",
     .formula = "gain c(dL), dL the axial drift since the first row, elongation positive: "
                "alpha = arcsin(sin 18° - 0.8 dL / (ball_diameter (groove_factor - 0.5))), "
                "theta = (180° - (18° - alpha)) / 2 - 72°, c = 0.8 dL tan theta; gain = 1 is the formula",
     .signature = "A radial drift of about a quarter of the axial one, less than proportional.",
     .confused_with = {"axial_crosstalk", "preload_loss", "expansion"},
     .separated_by = "Push lightly in all radial directions at rest, cold and warm: clearance yields in any direction. "
                     "An inclined axis always shifts in one direction and in proportion.",
     .remedy = "Keep the preload with springs or hydraulics; cool the rotor; check the preload when warm.",
     .validity = "Back-to-back pair with a contact angle of 18° at dL = 0; up to dL = 120 um, where the contact angle "
                 "is 0 for the paper's bearing. Negative dL continues the formula: the bearing closes again. Where the "
                 "arcsin has no value the contact angle stays at ±90°.",
     .source = "Huang, Li, Zhao 2022, eq. 29 to 32; the paper's table 2 does not follow from them."},
    {{"axial", {"um"}, "axial drift of the spindle, elongation positive"}},
    {gain_within("gain", "1", 1000.0, "1 is the formula"),
     {"ball_diameter_mm", "mm", ParameterKind::shape, 10.319, 1.0, 100.0, {}, "D_w", true},
     {"groove_factor", "1", ParameterKind::shape, 0.53, 0.505, 0.6, {}, "f, groove radius over ball diameter", true}},
    by_row<3>(BearingClearance{}),
};

}  // namespace ballbar::catalogue
