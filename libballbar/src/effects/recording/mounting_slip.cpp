#include "effects/evaluate.hpp"
#include "effects/step.hpp"

namespace ballbar::catalogue {

// Over the time of the rows, the sweeps end to end.
extern const Effect kMountingSlip{
    "mounting_slip",
    Level::recording,
    {.summary = "The length steps at one reading and does not return.",
     .cause = "A cup slips in its magnet, a chip gets under the foot, or somebody knocks the bar.",
     .formula = "step where time > onset, else 0; time of the rows, the sweeps put end to end",
     .signature = "A step at one place in one sweep, not at a reversal, and not repeated.",
     .confused_with = {"sweep_drift", "backlash_a", "backlash_b"},
     .separated_by =
         "Repeat the test: a slip does not recur. A step of play is at the reversals of its axis in both directions.",
     .remedy = "Clean and seat the cups, tighten the mount, repeat the test.",
     .validity = "One step, along the bar. A slip across the bar is a shift of the centre.",
     .source = "Unit step; not from a paper."},
    {},
    {gain_within("step_um", "um", 10000.0, "length after minus length before"),
     {"onset_s", "s", ParameterKind::shape, 0.0, 0.0, 1e7, {}, "time of the slip", false, ShapeOf::onset}},
    by_row<2>(Step{}),
    true,
};

}  // namespace ballbar::catalogue
