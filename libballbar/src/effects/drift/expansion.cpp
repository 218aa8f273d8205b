#include "effects/evaluate.hpp"
#include "effects/expansion_causes.hpp"

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
    {.summary = "Free expansion with one temperature.",
     .cause =
         "A body grows with its temperature. At the mean-value point of the spindle one sensor stands for the whole "
         "temperature field: gain = alpha L.",
     .formula = "gain (T - T0)",
     .signature = "The residual follows the temperature at once, the same while it rises and while it falls.",
     .confused_with = {"lagged_expansion", "gradient_bending", "axial_crosstalk"},
     .separated_by = "A step of the temperature (start, stop): what lags opens a loop of residual against temperature, "
                     "free expansion does not.",
     .remedy = "Put the sensor at the mean-value point; compensate by gain (T - T0); keep the coolant's temperature.",
     .validity = "One body of one temperature, free to grow; bearing steel and aluminium over tens of K are linear.",
     .source = "Huang, Li, Zhao 2022, eq. 21: dL = alpha L (T(xi) - T0)."},
    {{"temperature", {"degC", "K"}, "temperature of the body"}},
    {{"gain_um_per_K", "um/K", ParameterKind::gain, 0.0, -1000.0, 1000.0, {}, "growth for each kelvin: alpha L"}},
    by_row<1>(Expansion{}),
    false,
    {},
    {.is_common = true, .explains = expansion_causes()},
};

}  // namespace ballbar::catalogue
