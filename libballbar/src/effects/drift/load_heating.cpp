#include "effects/evaluate.hpp"
#include "effects/low_pass.hpp"

namespace ballbar::catalogue {
namespace {

// k LP_tau[P]
struct LoadHeating {
  template <class T>
  T operator()(const EffectRows& rows, std::size_t i, const T* p, T* kept) const {
    return low_pass_at(rows, i, T(rows.inputs[0][i]), p[1], false, kept) * p[0];
  }
};

}  // namespace

extern const Effect kLoadHeating{
    "load_heating",
    Level::series,
    {.summary = "Motor heat under load.",
     .cause = "The motor loses more power when cutting than when idling, and its heat reaches the spindle.",
     .formula = "gain LP_tau[P], P the load in the unit of its column",
     .signature = "An exponential after every change of load, at the same speed.",
     .confused_with = {"speed_heating", "lagged_expansion", "viscosity_feedback"},
     .separated_by = "Compare cutting and air-cutting at the same speed: speed_heating is equal in both.",
     .remedy = "Cool the motor; spread heavy cuts; finish after a pause or compensate with the load.",
     .validity =
         "Loss proportional to the load column. The loss of a current is quadratic, so use power if it is logged.",
     .source = "Heat balance of a lumped body; not from a paper."},
    {{"load", {"W", "A", "percent", "Nm"}, "power, current, torque or load of the spindle's motor"}},
    {gain_within("gain_um_per_unit", "um/unit", 1000.0, "final drift for one W, A, % or Nm"),
     time_constant({60.0, 180.0, 600.0, 1800.0, 5400.0, 16000.0}, "time constant of the warmed body")},
    by_row<2, kLowPassKept>(LoadHeating{}),
    false,
    {},
    {.is_common = true,
     .predictor = {{PredictorKind::source, {{60.0, 180.0, 600.0, 1800.0, 5400.0, 16000.0, 50000.0}}}}},
};

}  // namespace ballbar::catalogue
