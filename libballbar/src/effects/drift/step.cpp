#include "effects/step.hpp"

#include <limits>

#include "effects/evaluate.hpp"

namespace ballbar::catalogue {

extern const Effect kStep{
    "step",
    Level::series,
    {.summary = "A jump at one time.",
     .cause = "A knock, a slipping magnet or a tool change that is not logged.",
     .formula =
         "gain H(t - onset), t as in the data; a row counts with the share of the time since the row before that "
         "lies after the onset",
     .signature = "The residual jumps once and does not return.",
     .confused_with = {"linear_drift", "settling", "preload_loss", "centrifugal_shift"},
     .separated_by = "Repeat the run: a knock does not recur; a physical cause recurs at the same state.",
     .remedy = "Reseat the set-up and repeat; leave out the rows before or after; log events.",
     .validity = "One jump; its time is known to the interval between two measured rows at best.",
     .source = "Shift of the set-up; not from a paper."},
    {},
    {gain_within("gain_um", "um", 10000.0, "height of the jump"),
     {"onset_s",
      "s",
      ParameterKind::shape,
      0.0,
      -std::numeric_limits<double>::infinity(),
      std::numeric_limits<double>::infinity(),
      {},
      "time of the jump, in the time of the data; searched over all rows, or refined within a row of the stated start",
      false,
      ShapeOf::onset}},
    by_row<2>(Step{}),
    true,
    {},
    {.may_repeat = true},
};

}  // namespace ballbar::catalogue
