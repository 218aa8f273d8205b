#include "effects/drift_rows.hpp"
#include "effects/evaluate.hpp"
#include "effects/low_pass.hpp"

namespace ballbar::catalogue {
namespace {

// k LP[n^a] with tau_on while the spindle turns and tau_off while it stands. Between two rows the speed is a straight
// line, so it turns all the way unless both rows are at rest.
struct CoolingAsymmetry {
  template <class T>
  T operator()(const EffectRows& rows, std::size_t i, const T* p, T* kept) const {
    const T input = power_of_speed(rows.inputs[0][i], p[3]);
    const bool turns = input > T(0.0) || (i > 0 && kept[1] > T(0.0));
    const bool other_tau = turns != (kept[kLowPassKept] > T(0.0));
    kept[kLowPassKept] = T(turns ? 1.0 : 0.0);
    return p[0] * low_pass_at(rows, i, input, turns ? p[1] : p[2], other_tau, kept);
  }
};

}  // namespace

extern const Effect kCoolingAsymmetry{
    "cooling_asymmetry",
    Level::series,
    {.summary = "Friction heat that builds up faster than it decays.",
     .cause =
         "A turning spindle moves the air, and its coolant may run only then, so heat transfer is better than at rest.",
     .formula = "gain LP[n^exponent], n in krpm, the low pass with time_constant_turning while the spindle turns and "
                "time_constant_at_rest while it stands",
     .signature = "An exponential after a start and a slower one after a stop.",
     .confused_with = {"speed_heating", "lagged_expansion", "viscosity_feedback"},
     .separated_by = "Follow one start and one stop until each settles: they give the two time constants.",
     .remedy = "Keep coolant and air running at rest; warm up before work; compensate with both time constants.",
     .validity = "Lumped body; the same end value for the same speed; two states, turning and at rest.",
     .source = "Heat balance of a lumped body whose heat transfer has two values; not from a paper."},
    {{"speed", {"rpm"}, "speed of the spindle"}},
    {gain_within("gain_um_per_krpm_a", "um/krpm^a", 1000.0, "final drift at 1000 rpm"),
     time_constant({180.0, 600.0, 1800.0, 5400.0, 16000.0}, "time constant while the spindle turns",
                   "time_constant_turning_s"),
     time_constant({180.0, 600.0, 1800.0, 5400.0, 16000.0, 50000.0}, "time constant at rest", "time_constant_at_rest_s",
                   3600.0),
     {"exponent", "1", ParameterKind::shape, 5.0 / 3.0, 0.5, 3.0, {1.0, 5.0 / 3.0, 2.0}, "a, of the speed", true}},
    by_row<4, kLowPassKept + 1>(CoolingAsymmetry{}),
    false,
    {},
    {.becomes = "speed_heating",
     .is_common = true,
     .explains = {{SpindleCause::rings}},
     .predictor = {{PredictorKind::feedback, {{600.0, 1800.0, 5400.0}, {180.0, 1800.0, 16000.0}, {1.0, 5.0 / 3.0}}}}},
};

}  // namespace ballbar::catalogue
