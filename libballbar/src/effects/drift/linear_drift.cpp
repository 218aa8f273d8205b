#include "effects/evaluate.hpp"

namespace ballbar::catalogue {
namespace {

// k t
struct LinearDrift {
  template <class T>
  T operator()(const EffectRows& rows, std::size_t i, const T* p, T*) const {
    return p[0] * ((rows.time_s[i] - rows.time_s[0]) / 3600.0);
  }
};

}  // namespace

extern const Effect kLinearDrift{
    "linear_drift",
    Level::series,
    {.summary = "A steady drift of the instrument or the set-up.",
     .cause = "Amplifier, battery or mount change slowly and steadily, independent of the machine.",
     .formula = "rate t, t since the first row",
     .signature = "The residual is a straight line over time.",
     .confused_with = {"settling", "day_cycle", "step", "lagged_expansion"},
     .separated_by =
         "Record a run of the same length with the machine warm and at rest: the instrument drifts equally.",
     .remedy = "Let the instrument warm up; repeat the first test at the end; replace the battery.",
     .validity = "Rate constant over the run.",
     .source = "First order of any slow drift; not from a paper."},
    {},
    {gain_within("rate_um_per_h", "um/h", 1000.0, "drift in an hour")},
    by_row<1>(LinearDrift{}),
    true,
};

}  // namespace ballbar::catalogue
