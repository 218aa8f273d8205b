#include "catalogue.hpp"
#include "evaluate.hpp"
#include "low_pass.hpp"
#include "speed.hpp"

namespace ballbar::catalogue {
namespace {

// k LP[n^a] with tau_on while the spindle turns and tau_off while it stands. Between two rows the speed is a straight
// line, so it turns all the way unless both rows are at rest.
struct CoolingAsymmetry {
  template <class T>
  void operator()(const EffectRows& rows, const T* p, T* out) const {
    const std::span<const double> speed_rpm = rows.inputs[0];
    if (speed_rpm.empty()) return;
    T last = power_of_speed(speed_rpm[0], p[3]);
    T state = last;
    out[0] = p[0] * state;
    double dt_s = -1.0;
    bool turning = false;
    LowPassStep<T> step{};
    for (std::size_t i = 1; i < speed_rpm.size(); ++i) {
      const T next = power_of_speed(speed_rpm[i], p[3]);
      const double now_s = rows.time_s[i] - rows.time_s[i - 1];
      const bool turns = next > T(0.0) || last > T(0.0);
      if (now_s != dt_s || turns != turning) {
        dt_s = now_s;
        turning = turns;
        step = low_pass_step(dt_s, turning ? p[1] : p[2]);
      }
      state += step.towards * (last - state) + (next - last) * step.along;
      last = next;
      out[i] = p[0] * state;
    }
  }
};

}  // namespace

const Effect kCoolingAsymmetry{
    "cooling_asymmetry",
    Level::series,
    {.summary = "Friction heat that comes faster than it goes.",
     .cause = "A turning spindle moves the air, and its coolant may run only then: heat passes better than at rest.",
     .formula = "gain LP[n^exponent], n in krpm, the low pass with time_constant_turning while the spindle turns and "
                "time_constant_at_rest while it stands",
     .signature = "An exponential after a start and a slower one after a stop.",
     .confused_with = {"speed_heating", "lagged_expansion", "viscosity_feedback"},
     .becomes = "speed_heating",
     .separated_by = "One start and one stop, each followed until it settles: the two time constants are read apart.",
     .remedy = "Let coolant and air run on at rest; warm up before work; compensate with both time constants.",
     .validity = "Lumped body; the same end value for the same speed; two states, turning and at rest.",
     .source = "Heat balance of a lumped body whose heat transfer has two values; no paper's equation."},
    {{"speed", {"rpm"}, "speed of the spindle"}},
    {{"gain_um_per_krpm_a", "um/krpm^a", ParameterKind::gain, 0.0, -1000.0, 1000.0, {}, "drift in the end at 1000 rpm"},
     {"time_constant_turning_s",
      "s",
      ParameterKind::shape,
      1800.0,
      10.0,
      200000.0,
      {180.0, 600.0, 1800.0, 5400.0, 16000.0},
      "how slowly the body follows while the spindle turns"},
     {"time_constant_at_rest_s",
      "s",
      ParameterKind::shape,
      3600.0,
      10.0,
      200000.0,
      {180.0, 600.0, 1800.0, 5400.0, 16000.0, 50000.0},
      "how slowly the body follows while it stands"},
     {"exponent", "1", ParameterKind::shape, 5.0 / 3.0, 0.5, 3.0, {1.0, 5.0 / 3.0, 2.0}, "a, of the speed", true}},
    evaluated_by<4>(CoolingAsymmetry{}),
};

}  // namespace ballbar::catalogue
