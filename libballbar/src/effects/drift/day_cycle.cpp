#include "effects/cycle.hpp"
#include "effects/evaluate.hpp"

namespace ballbar::catalogue {

extern const Effect kDayCycle{
    "day_cycle",
    Level::series,
    {.summary = "Day and night that nobody logged.",
     .cause = "The hall warms by day and cools by night, and the sun reaches one side of the machine.",
     .formula = "cosine cos(2 pi t / period) + sine sin(2 pi t / period), t since the first row, period 24 h",
     .signature = "A slow swing of the residual with the time of day.",
     .confused_with = {"lagged_expansion", "linear_drift", "settling"},
     .separated_by = "Log the room and measure over more than 24 h, once with the spindle at rest.",
     .remedy = "Close doors, shade windows, control the room; a sensor in the room and lagged_expansion.",
     .validity = "A day like the one before; a run of less than half a day looks like a drift.",
     .source = "First harmonic of the day; no paper's equation."},
    {},
    {{"cosine_um", "um", ParameterKind::gain, 0.0, -1000.0, 1000.0, {}, "part that is largest at the first row"},
     {"sine_um", "um", ParameterKind::gain, 0.0, -1000.0, 1000.0, {}, "part that is 0 at the first row and rises"},
     {"period_s",
      "s",
      ParameterKind::shape,
      86400.0,
      43200.0,
      172800.0,
      {},
      "24 h",
      true,
      ShapeOf::period,
      cycle_periods}},
    by_row<3>(Cycle{}),
    true,
};

}  // namespace ballbar::catalogue
