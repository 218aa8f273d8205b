#include <cmath>

#include "effects/drift_rows.hpp"
#include "effects/evaluate.hpp"
#include "effects/low_pass.hpp"

namespace ballbar::catalogue {
namespace {

// k LP_tau[n exp(-b (T - T_0))]
struct ViscosityFeedback {
  template <class T>
  T operator()(const EffectRows& rows, std::size_t i, const T* p, T* kept) const {
    using std::exp;
    const std::span<const double> temperature = rows.inputs[1];
    const T friction = std::abs(rows.inputs[0][i]) / 1000.0 * exp(-p[2] * (temperature[i] - zero_of(rows, 1)));
    return low_pass_at(rows, i, friction, p[1], false, kept) * p[0];
  }
};

}  // namespace

extern const Effect kViscosityFeedback{
    "viscosity_feedback",
    Level::series,
    {.summary = "Friction heat that decreases as the lubricant warms.",
     .cause = "Warm oil or grease is thinner, so a cold bearing has more friction than a warm one at the same speed.",
     .formula = "gain LP_tau[n exp(-viscosity_loss (T - T0))], n in krpm",
     .signature =
         "At constant speed the drift overshoots and returns slightly. A warm start drifts less than a cold one.",
     .confused_with = {"speed_heating", "cooling_asymmetry", "lagged_expansion"},
     .separated_by = "Run the same speed once from cold and once from warm: without feedback both drift equally.",
     .remedy = "Warm up before work; use grease or oil with a smaller change of viscosity; use less grease.",
     .validity = "Friction proportional to speed and viscosity; viscosity exponential over about 20 K around T0.",
     .source = "Heat balance of a lumped body with a lubricant whose viscosity falls exponentially; not from a paper."},
    {{"speed", {"rpm"}, "speed of the spindle"},
     {"temperature", {"degC", "K"}, "temperature of the bearing", is_inside}},
    {gain_within("gain_um_per_krpm", "um/krpm", 1000.0, "final drift at 1000 rpm, lubricant at T0"),
     time_constant({180.0, 600.0, 1800.0, 5400.0, 16000.0}, "time constant of the warmed body"),
     {"viscosity_loss_per_K",
      "1/K",
      ParameterKind::shape,
      0.03,
      0.0,
      0.2,
      {0.01, 0.03, 0.06},
      "relative loss of viscosity for each kelvin"}},
    by_row<3, kLowPassKept>(ViscosityFeedback{}),
    false,
    {},
    {.becomes = "speed_heating",
     .is_common = true,
     .explains = {{SpindleCause::rings}},
     .predictor = {{PredictorKind::feedback, {{600.0, 1800.0, 5400.0}, {0.03}}}}},
};

}  // namespace ballbar::catalogue
