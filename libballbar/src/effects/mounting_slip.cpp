#include <algorithm>

#include "catalogue.hpp"
#include "evaluate.hpp"

namespace ballbar::catalogue {
namespace {

// k H_i over the time of the rows, the sweeps end to end; H_i the share of the time from row i - 1 to row i that lies
// after the onset, as in `step`: an onset on a row's time is the exact step just after that row.
struct MountingSlip {
  template <class T>
  void operator()(const EffectRows& rows, const T* p, T* out) const {
    const std::span<const double> time_s = rows.time_s;
    for (std::size_t i = 0; i < time_s.size(); ++i) {
      const std::size_t end = std::min(std::max<std::size_t>(i, 1), time_s.size() - 1);
      const double width_s = end > 0 ? time_s[end] - time_s[end - 1] : 1.0;
      const T share = (time_s[i] - p[1]) / width_s;
      if (!(share > T(0.0))) {
        out[i] = T(0.0);
      } else if (share > T(1.0)) {
        out[i] = p[0];
      } else {
        out[i] = p[0] * share;
      }
    }
  }
};

}  // namespace

const Effect kMountingSlip{
    "mounting_slip",
    Level::recording,
    {.summary = "The length steps at one reading and stays there.",
     .cause = "A cup slips in its magnet, a chip gets under the foot, somebody knocks against the bar.",
     .formula = "step where time > onset, else 0; time of the rows, the sweeps put end to end",
     .signature = "A step at one place in one sweep, at no reversal, never again in the same place.",
     .confused_with = {"sweep_drift", "backlash_a", "backlash_b"},
     .separated_by =
         "Repeat the test: a slip is not repeated. A step of play sits at the reversals of its axis in both "
         "directions.",
     .remedy = "Clean and seat the cups, tighten the mount, repeat the test.",
     .validity = "One step, along the bar. A slip across the bar is a shift of the centre.",
     .source = "Unit step; no paper's equation."},
    {},
    {{"step_um", "um", ParameterKind::gain, 0.0, -10000.0, 10000.0, {}, "length after less length before"},
     {"onset_s", "s", ParameterKind::shape, 0.0, 0.0, 1e7, {}, "time of the slip"}},
    evaluated_by<2>(MountingSlip{}),
    true,
};

}  // namespace ballbar::catalogue
