#include "effects/drift_rows.hpp"
#include "effects/evaluate.hpp"

namespace ballbar::catalogue {

extern const Effect kDayCycle{
    "day_cycle",
    Level::series,
    {.summary = "A day-night cycle that is not logged.",
     .cause = "The hall warms by day and cools by night. The sun may reach one side of the machine.",
     .formula = "cosine cos(2 pi t / period) + sine sin(2 pi t / period), t since the first row, period 24 h",
     .signature = "A slow oscillation of the residual with the time of day.",
     .confused_with = {"lagged_expansion", "linear_drift", "settling"},
     .separated_by = "Log the room and measure over more than 24 h, once with the spindle at rest.",
     .remedy = "Close doors, shade windows, control the room; a sensor in the room and lagged_expansion.",
     .validity = "Equal days; in a run shorter than half a day it looks like a drift.",
     .source = "First harmonic of the day; not from a paper."},
    {},
    cycle_parameters(86400.0, 43200.0, 172800.0, {}, "24 h", true),
    by_row<3>(Cycle{}),
    true,
};

}  // namespace ballbar::catalogue
