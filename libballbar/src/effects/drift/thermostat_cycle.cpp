#include "effects/cycle.hpp"
#include "effects/evaluate.hpp"

namespace ballbar::catalogue {

extern const Effect kThermostatCycle{
    "thermostat_cycle",
    Level::series,
    {.summary = "On and off of a chiller or heater that nobody logged.",
     .cause = "A two-point thermostat lets coolant, cabinet or room swing between its limits.",
     .formula = "cosine cos(2 pi t / period) + sine sin(2 pi t / period), t since the first row",
     .signature = "The residual swings with one period of 3 to 60 min, whatever the spindle does.",
     .confused_with = {"day_cycle", "lagged_expansion", "play_hysteresis"},
     .separated_by =
         "Log the coolant's temperature; switch the chiller off for some periods: the swing stops or it does "
         "not. Rows must be closer than half the period.",
     .remedy = "A chiller with a continuous control; a larger tank; a sensor in the coolant and lagged_expansion.",
     .validity = "One steady period; the harmonics of the on-off shape are left in the residual.",
     .source = "First harmonic of a two-point control; no paper's equation."},
    {},
    {{"cosine_um", "um", ParameterKind::gain, 0.0, -1000.0, 1000.0, {}, "part that is largest at the first row"},
     {"sine_um", "um", ParameterKind::gain, 0.0, -1000.0, 1000.0, {}, "part that is 0 at the first row and rises"},
     {"period_s",
      "s",
      ParameterKind::shape,
      900.0,
      180.0,
      3600.0,
      {180.0, 236.0, 310.0, 407.0, 535.0, 702.0, 922.0, 1211.0, 1590.0, 2088.0, 2742.0, 3600.0},
      "of the thermostat",
      false,
      ShapeOf::period,
      cycle_periods}},
    by_row<3>(Cycle{}),
    true,
    {},
    {.may_repeat = true},
};

}  // namespace ballbar::catalogue
