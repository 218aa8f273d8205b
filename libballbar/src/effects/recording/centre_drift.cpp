#include <cmath>

#include "ballbar/units.hpp"
#include "effects/evaluate.hpp"
#include "effects/recording_rows.hpp"

namespace ballbar::catalogue {
namespace {

// t (k_a cos theta + k_b sin theta)
struct CentreDrift {
  template <class T>
  void operator()(const EffectRows& rows, const T* p, T* out) const {
    const std::span<const double> angle_rad = rows.inputs[0], sweep_s = rows.inputs[1];
    for (std::size_t i = 0; i < angle_rad.size(); ++i) {
      out[i] = min_from_s(sweep_s[i]) * (p[0] * std::cos(angle_rad[i]) + p[1] * std::sin(angle_rad[i]));
    }
  }
};

}  // namespace

extern const Effect kCentreDrift{
    "centre_drift",
    Level::recording,
    {.summary = "The centre wanders during the sweep.",
     .cause = "Spindle or table drifts sideways while the circle is driven: warming, cooling, a chiller that switches.",
     .formula = "t (rate_a cos theta + rate_b sin theta), t from the middle of the sweep",
     .signature = "The end of the sweep is shifted against its beginning; both directions drift in the same sense of "
                  "time.",
     .confused_with = {"sweep_drift", "backlash_a", "backlash_b", "lateral_play_a", "lateral_play_b"},
     .separated_by = "Both directions and a slower feed: drift grows with the time the sweep takes, play does not and "
                     "changes sides with the direction.",
     .remedy = "Wait until the spindle's temperature is steady, or make the sweep shorter; then compensate the drift.",
     .validity = "A rate that is the same in all the sweeps, small against the radius.",
     .source = "Length equation with c = c0 + k t, first order."},
    {angle_input(), sweep_input()},
    {{"rate_a_um_per_min", "um/min", ParameterKind::gain, 0.0, -10000.0, 10000.0, {}, "of the centre along A"},
     {"rate_b_um_per_min", "um/min", ParameterKind::gain, 0.0, -10000.0, 10000.0, {}, "of the centre along B"}},
    evaluated_by<2>(CentreDrift{}),
};

}  // namespace ballbar::catalogue
