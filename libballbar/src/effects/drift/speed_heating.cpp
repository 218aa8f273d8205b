#include "effects/drift_rows.hpp"
#include "effects/evaluate.hpp"
#include "effects/low_pass.hpp"

namespace ballbar::catalogue {
namespace {

// k LP_tau[n^a]
struct SpeedHeating {
  template <class T>
  T operator()(const EffectRows& rows, std::size_t i, const T* p, T* kept) const {
    return low_pass_at(rows, i, power_of_speed(rows.inputs[0][i], p[2]), p[1], false, kept) * p[0];
  }
};

}  // namespace

extern const Effect kSpeedHeating{
    "speed_heating",
    Level::series,
    {.summary = "Friction heat with no sensor near it.",
     .cause = "Bearings and motor heat up with speed. The parts they warm expand with their own time constant.",
     .formula = "gain LP_tau[n^a], n in krpm; a = 1 load term, 5/3 viscous friction, 2 windage",
     .signature = "An exponential after every change of speed, larger at higher speed.",
     .confused_with = {"lagged_expansion", "cooling_asymmetry", "viscosity_feedback", "centrifugal_shift"},
     .separated_by = "Run two speeds for the exponent and a stop for the time constant: heat decays slowly, "
                     "centrifugal shift at once.",
     .remedy =
         "Place a sensor near the bearings; use less or thinner lubricant; cool the housing; warm up before work.",
     .validity = "Lumped body; friction that does not change as the lubricant warms.",
     .source = "Heat balance of a lumped body with bearing friction after Palmgren (exponents); not from a paper."},
    {{"speed", {"rpm"}, "speed of the spindle"}},
    {gain_within("gain_um_per_krpm_a", "um/krpm^a", 1000.0, "final drift at 1000 rpm"),
     time_constant({60.0, 180.0, 600.0, 1800.0, 5400.0, 16000.0}, "time constant of the warmed body"),
     {"exponent", "1", ParameterKind::shape, 5.0 / 3.0, 0.5, 3.0, {1.0, 5.0 / 3.0, 2.0}, "of the speed", true}},
    by_row<3, kLowPassKept>(SpeedHeating{}),
    false,
    {},
    {.predictor = {{PredictorKind::source,
                    {{60.0, 180.0, 400.0, 900.0, 1800.0, 3600.0, 7200.0, 16000.0, 50000.0}, {1.0, 5.0 / 3.0, 2.0}}}}},
};

}  // namespace ballbar::catalogue
