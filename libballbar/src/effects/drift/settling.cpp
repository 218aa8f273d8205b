#include <cmath>

#include "effects/evaluate.hpp"
#include "effects/low_pass.hpp"

namespace ballbar::catalogue {
namespace {

// k (1 - exp(-t / tau))
struct Settling {
  template <class T>
  T operator()(const EffectRows& rows, std::size_t i, const T* p, T*) const {
    using std::expm1;
    return -p[0] * expm1(-(rows.time_s[i] - rows.time_s[0]) / p[1]);
  }
};

}  // namespace

extern const Effect kSettling{
    "settling",
    Level::series,
    {.summary = "Creep or run-in of the mounting that happens once.",
     .cause = "A magnet, clamp or new bearing settles after the set-up.",
     .formula = "gain (1 - exp(-t / time_constant)), t since the first row",
     .signature = "An exponential from the first row that no later change of speed repeats.",
     .confused_with = {"linear_drift", "lagged_expansion", "speed_heating", "day_cycle", "step"},
     .separated_by = "Repeat the run without touching the set-up: settling does not recur, a lag does.",
     .remedy = "Clean and reseat the mounts; wait before the first reading; discard the first rows.",
     .validity = "One time constant; nothing moved since the first row.",
     .source = "Exponential creep; not from a paper."},
    {},
    {gain_within("gain_um", "um", 1000.0, "final shift"),
     time_constant({60.0, 180.0, 600.0, 1800.0, 5400.0, 16000.0}, "time constant of the settling")},
    by_row<2>(Settling{}),
    true,
};

}  // namespace ballbar::catalogue
