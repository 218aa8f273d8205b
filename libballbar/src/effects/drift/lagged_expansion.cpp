#include "effects/drift_rows.hpp"
#include "effects/evaluate.hpp"
#include "effects/low_pass.hpp"

namespace ballbar::catalogue {
namespace {

// k (LP_tau[T] - T_0)
struct LaggedExpansion {
  template <class T>
  T operator()(const EffectRows& rows, std::size_t i, const T* p, T* kept) const {
    const std::span<const double> temperature = rows.inputs[0];
    return low_pass_at(rows, i, T(temperature[i] - temperature[0]), p[1], false, kept) * p[0];
  }
};

}  // namespace

extern const Effect kLaggedExpansion{
    "lagged_expansion",
    Level::series,
    {.summary = "A body that follows a temperature with a delay.",
     .cause = "Heat needs time to reach the body, such as the structure behind the sensor, the column that follows the "
              "room or the housing that follows the coolant.",
     .formula = "gain (LP_tau[T] - T0), LP_tau the first-order low pass",
     .signature =
         "Residual against temperature forms a loop: small while warming, large while cooling, or the reverse.",
     .confused_with = {"speed_heating", "day_cycle", "settling", "expansion"},
     .separated_by = "Step this temperature alone at constant speed, by door, air conditioning or chiller.",
     .remedy = "Move the sensor nearer to the body, shield it from draught, or compensate with the lag.",
     .validity = "One dominant time constant; a thick wall has several.",
     .source = "Heat balance of a lumped body; not from a paper."},
    {{"temperature", {"degC", "K"}, "temperature that the body follows"}},
    {growth_of_steel("final growth for each kelvin"), time_constant({60.0, 100.0, 180.0, 330.0, 600.0, 1000.0, 1800.0,
                                                                     3300.0, 5400.0, 9500.0, 16000.0, 29000.0, 50000.0},
                                                                    "time constant of the body")},
    by_row<2, kLowPassKept>(LaggedExpansion{}),
    false,
    {},
    {.becomes = "expansion",
     .is_common = true,
     .explains = expansion_causes(),
     .predictor = {{PredictorKind::temperature, {{0.0, 180.0, 600.0, 1800.0, 3600.0, 7200.0, 16000.0, 50000.0}}}}},
};

}  // namespace ballbar::catalogue
