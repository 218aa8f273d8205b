#include "effects/evaluate.hpp"
#include "effects/low_pass.hpp"

namespace ballbar::catalogue {
namespace {

// k LP_tau[D - D_0], D = T_hot - T_cold
struct GradientBending {
  template <class T>
  T operator()(const EffectRows& rows, std::size_t i, const T* p, T* kept) const {
    const std::span<const double> hot = rows.inputs[0];
    const std::span<const double> cold = rows.inputs[1];
    const T difference((hot[i] - hot[0]) - (cold[i] - cold[0]));
    return low_pass_at(rows, i, difference, p[1], false, kept) * p[0];
  }
};

}  // namespace

extern const Effect kGradientBending{
    "gradient_bending",
    Level::series,
    {.summary = "A wall bends when one side is warmer.",
     .cause = "One side of a column, headstock or ram warms more than the other, expands more and tilts the spindle.",
     .formula = "gain LP_tau[D - D0], D = T_hot - T_cold; tau = 0: at once",
     .signature = "The residual follows the difference of two temperatures, not their level.",
     .confused_with = {"expansion", "lagged_expansion", "bearing_rings"},
     .separated_by =
         "Warm both sides alike (room), then one side alone (coolant off, lamp): only the second causes bending.",
     .remedy = "Shield or insulate one side; run coolant through both; compensate with the difference.",
     .validity = "Linear gradient through the wall; small angles; one dominant time constant.",
     .source = "Bending of a bar with a linear temperature gradient: alpha length^2 / (2 thickness) for each kelvin of "
               "difference; not from a paper."},
    {{"hot", {"degC", "K"}, "temperature of the side that is warmer"},
     {"cold", {"degC", "K"}, "temperature of the other side"}},
    {gain_within("gain_um_per_K", "um/K", 1000.0, "shift for each kelvin of difference"),
     {"time_constant_s",
      "s",
      ParameterKind::shape,
      600.0,
      0.0,
      200000.0,
      {0.0, 180.0, 600.0, 1800.0, 5400.0, 16000.0},
      "time constant of the wall; 0: no delay"}},
    by_row<2, kLowPassKept>(GradientBending{}),
    false,
    {},
    {.first_input_warmest = true,
     .is_common = true,
     .explains = {{SpindleCause::structure, true}, {SpindleCause::bending}},
     .predictor = {{PredictorKind::difference, {{0.0, 1800.0, 7200.0, 16000.0}}, "lagged_expansion"}}},
};

}  // namespace ballbar::catalogue
