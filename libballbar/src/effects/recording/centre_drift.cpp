#include <cmath>

#include "ballbar/units.hpp"
#include "effects/evaluate.hpp"
#include "effects/recording_rows.hpp"

namespace ballbar::catalogue {
namespace {

// t (k_a cos theta + k_b sin theta)
struct CentreDrift {
  template <class T>
  T operator()(const EffectRows& rows, std::size_t i, const T* p, T*) const {
    const std::span<const double> angle_rad = rows.inputs[0], sweep_s = rows.inputs[1];
    return min_from_s(sweep_s[i]) * (p[0] * std::cos(angle_rad[i]) + p[1] * std::sin(angle_rad[i]));
  }
};

}  // namespace

extern const Effect kCentreDrift{
    "centre_drift",
    Level::recording,
    {.summary = "The centre drifts during the sweep.",
     .cause = "Spindle or table drifts sideways during the circle because of warming, cooling or a switching chiller.",
     .formula = "t (rate_a cos theta + rate_b sin theta), t from the middle of the sweep",
     .signature = "The end of the sweep is shifted from its start; both directions drift alike in time.",
     .confused_with = {"sweep_drift", "backlash_a", "backlash_b", "lateral_play_a", "lateral_play_b"},
     .separated_by = "Measure both directions and a slower feed: drift grows with the duration of the sweep. Play does "
                     "not, and it changes side with the direction.",
     .remedy = "Wait for a steady spindle temperature or shorten the sweep; then compensate the drift.",
     .validity = "Equal rate in all sweeps, small compared with the radius.",
     .source = "Length equation with c = c0 + k t, first order."},
    {angle_input(), sweep_input()},
    {gain_within("rate_a_um_per_min", "um/min", 10000.0, "of the centre along A"),
     gain_within("rate_b_um_per_min", "um/min", 10000.0, "of the centre along B")},
    by_reading<2>(CentreDrift{}),
};

}  // namespace ballbar::catalogue
