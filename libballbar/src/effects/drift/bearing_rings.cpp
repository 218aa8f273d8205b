#include "effects/drift_rows.hpp"
#include "effects/evaluate.hpp"

namespace ballbar::catalogue {
namespace {

// s (r_C alpha (T_C - T_C0) - r_B alpha (T_B - T_B0)); mm times ppm is nm, hence 1e-3 to um.
struct BearingRings {
  template <class T>
  T operator()(const EffectRows& rows, std::size_t i, const T* p, T*) const {
    const std::span<const double> inner = rows.inputs[0];
    const std::span<const double> outer = rows.inputs[1];
    const T r_b_mm = p[1], r_c_mm = p[2], alpha_ppm_per_K = p[3];
    const T opened_mm_K = r_c_mm * (outer[i] - outer[0]) - r_b_mm * (inner[i] - inner[0]);
    return p[0] * (alpha_ppm_per_K * opened_mm_K * 1e-3);
  }
};

}  // namespace

extern const Effect kBearingRings{
    "bearing_rings",
    Level::series,
    {.summary = "Rings of unequal growth open or close the bearing.",
     .cause = "The raceways of the outer and the inner ring expand with their own temperatures. Their difference is "
              "clearance; a warmer inner ring reduces it.",
     .formula = "gain (outer_radius expansion (T_outer - T_outer0) - inner_radius expansion (T_inner - T_inner0)); "
                "gain = 1 is the formula",
     .signature = "A radial drift of about a micrometre that follows both ring temperatures.",
     .confused_with = {"expansion", "gradient_bending", "bearing_clearance"},
     .separated_by =
         "Warm the inner ring alone (speed with the housing cooled) and the outer ring alone (coolant): the "
         "signs are opposite.",
     .remedy =
         "Cool the inner ring or the housing so that both rings warm alike; choose the preload for the warm state.",
     .validity = "Uniform temperature of each ring, no contact forces; ceramic balls, which hardly expand.",
     .source = "Huang, Li, Zhao 2022, eq. 15, 17 and 18 with one temperature for each ring; radii and "
               "expansion are those of the paper's bearing."},
    {{"inner", {"degC", "K"}, "temperature of the inner ring", is_inside},
     {"outer", {"degC", "K"}, "temperature of the outer ring", is_inside}},
    {gain_within("gain", "1", 1000.0, "1 is the formula"),
     {"inner_radius_mm", "mm", ParameterKind::shape, 27.34, 1.0, 1000.0, {}, "r_B, raceway of the inner ring", true},
     {"outer_radius_mm", "mm", ParameterKind::shape, 37.66, 1.0, 1000.0, {}, "r_C, raceway of the outer ring", true},
     {"expansion_ppm_per_K", "ppm/K", ParameterKind::shape, 13.6, 1.0, 30.0, {}, "alpha of the rings", true}},
    by_row<4>(BearingRings{}),
    false,
    {},
    {.is_common = true, .explains = {{SpindleCause::rings}}},
};

}  // namespace ballbar::catalogue
