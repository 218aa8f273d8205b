#include "ballbar/units.hpp"
#include "effects/evaluate.hpp"
#include "effects/recording_rows.hpp"

namespace ballbar::catalogue {
namespace {

// k (t - t_mid)
struct SweepDrift {
  template <class T>
  T operator()(const EffectRows& rows, std::size_t i, const T* p, T*) const {
    const std::span<const double> sweep_s = rows.inputs[0];
    return p[0] * min_from_s(sweep_s[i]);
  }
};

}  // namespace

extern const Effect kSweepDrift{
    "sweep_drift",
    Level::recording,
    {.summary = "The length changes during the sweep, so the figure does not close.",
     .cause = "The bar, its set-up or the machine warms up during the circle.",
     .formula = "rate t, t from the middle of the sweep",
     .signature = "A full turn ends higher or lower than it started; both directions drift alike in time.",
     .confused_with = {"mounting_slip", "centre_drift", "circle"},
     .separated_by = "Repeat the test after a rest: drift fades as temperatures settle, a slip does not recur. At a "
                     "slower feed the drift is larger.",
     .remedy =
         "Let bar and machine reach a steady temperature before the test; keep hands and draught away from the bar.",
     .validity = "Equal rate in all sweeps. Without times or feed, one reading per second is assumed.",
     .source = "First term of any slow drift; not from a paper."},
    {sweep_input()},
    {gain_within("rate_um_per_min", "um/min", 10000.0, "growth of the length")},
    by_reading<1>(SweepDrift{}),
    true,
};

}  // namespace ballbar::catalogue
