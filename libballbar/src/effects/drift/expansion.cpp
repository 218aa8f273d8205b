#include "effects/drift_rows.hpp"
#include "effects/evaluate.hpp"

namespace ballbar::catalogue {
namespace {

// k (T - T_0)
struct Expansion {
  template <class T>
  T operator()(const EffectRows& rows, std::size_t i, const T* p, T*) const {
    const std::span<const double> temperature = rows.inputs[0];
    return p[0] * (temperature[i] - temperature[0]);
  }
};

}  // namespace

extern const Effect kExpansion{
    "expansion",
    Level::series,
    {.summary = "Free thermal expansion with one temperature.",
     .cause = "A body expands with its temperature. At the mean-value point of the spindle one sensor represents the "
              "whole temperature field: gain = alpha L.",
     .formula = "gain (T - T0)",
     .signature = "The residual follows the temperature without delay, equally while it rises and falls.",
     .confused_with = {"lagged_expansion", "gradient_bending", "axial_crosstalk"},
     .separated_by = "Step the temperature (start, stop): a lag opens a loop of residual against temperature, free "
                     "expansion does not.",
     .remedy = "Place the sensor at the mean-value point; compensate by gain (T - T0); hold the coolant temperature.",
     .validity =
         "One body of uniform temperature, free to expand; bearing steel and aluminium are linear over tens of K.",
     .source = "Huang, Li, Zhao 2022, eq. 21: dL = alpha L (T(xi) - T0)."},
    {{"temperature", {"degC", "K"}, "temperature of the body"}},
    {growth_of_steel("growth for each kelvin: alpha L")},
    by_row<1>(Expansion{}),
    false,
    {},
    {.is_common = true, .explains = expansion_causes()},
};

}  // namespace ballbar::catalogue
