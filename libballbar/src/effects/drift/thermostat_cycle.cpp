#include "effects/drift_rows.hpp"
#include "effects/evaluate.hpp"

namespace ballbar::catalogue {

extern const Effect kThermostatCycle{
    "thermostat_cycle",
    Level::series,
    {.summary = "On-off cycle of a chiller or heater that is not logged.",
     .cause = "An on-off thermostat lets coolant, cabinet or room oscillate between its limits.",
     .formula = "cosine cos(2 pi t / period) + sine sin(2 pi t / period), t since the first row",
     .signature = "The residual oscillates with one period of 3 to 60 min, independent of the spindle.",
     .confused_with = {"day_cycle", "lagged_expansion", "play_hysteresis"},
     .separated_by = "Log the coolant temperature, or switch the chiller off for some periods: the oscillation stops "
                     "if the chiller causes it. Rows must be closer than half the period.",
     .remedy =
         "Use a chiller with continuous control or a larger tank; add a sensor in the coolant and lagged_expansion.",
     .validity = "One steady period; the harmonics of the on-off shape remain in the residual.",
     .source = "First harmonic of an on-off control; not from a paper."},
    {},
    cycle_parameters(900.0, 180.0, 3600.0,
                     {180.0, 236.0, 310.0, 407.0, 535.0, 702.0, 922.0, 1211.0, 1590.0, 2088.0, 2742.0, 3600.0},
                     "of the thermostat", false),
    by_row<3>(Cycle{}),
    true,
    {},
    {.may_repeat = true},
};

}  // namespace ballbar::catalogue
