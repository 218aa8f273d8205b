#include "effects/evaluate.hpp"

namespace ballbar::catalogue {
namespace {

// L alpha_bar (T_bar - 20 degC); mm times ppm is nm, hence 1e-3 to um.
struct BarTemperature {
  template <class T>
  T operator()(const EffectRows& rows, std::size_t i, const T* p, T*) const {
    return p[0] * p[1] * ((rows.inputs[0][i] - 20.0) * 1e-3);
  }
};

}  // namespace

extern const Effect kBarTemperature{
    "bar_temperature",
    Level::series,
    {.summary = "The bar itself expands.",
     .cause = "Bar and extension are calibrated at 20 °C and expand with their own temperature, set by hands, coolant "
              "and room.",
     .formula = "length expansion (T_bar - 20 °C)",
     .signature =
         "The residual follows the bar's temperature, with about the expansion of its material times its length.",
     .confused_with = {"expansion", "lagged_expansion", "day_cycle"},
     .separated_by = "Measure the same set-up with a longer bar, or warm the bar alone: only the bar's share changes.",
     .remedy = "Let the bar take the machine's temperature; gloves; calibrate on the Zerodur gauge; a bar with low "
               "expansion.",
     .validity = "Uniform temperature of the bar. A fitted expansion far from that of its material has another cause.",
     .source = "Definition of the expansion coefficient, at the reference temperature of 20 °C."},
    {{"temperature",
      {"degC"},
      "temperature of the bar",
      [](const Column& column) { return column.name.find("bar") != std::string::npos; },
      false,
      "no column whose name contains \"bar\""}},
    {gain_within("expansion_ppm_per_K", "ppm/K", 100.0, "of the bar; negative where a longer bar reads less"),
     {"length_mm", "mm", ParameterKind::shape, 100.0, 1.0, 2000.0, {}, "of the bar with its extension", true}},
    by_row<2>(BarTemperature{}),
};

}  // namespace ballbar::catalogue
