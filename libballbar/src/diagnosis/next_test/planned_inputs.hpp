// Simulates the logged inputs of a planned test.
//
// Speeds are as scheduled. A load follows the speed as in the data, times the factor of the schedule. The room
// continues with the values of the data from a random moment on, forwards and backwards, plus the scheduled steps.
// Every other column follows speed, room and coolant as in the data (thermal_forecast.hpp), with its residual continued
// like the room; a column that follows nothing (R2 < 0.5) continues with its own values. All values are rounded as
// logged. Equal columns stay equal.
#pragma once

#include <random>
#include <string_view>
#include <vector>

#include "ballbar/diagnosis/next_test/plan.hpp"
#include "ballbar/series/series.hpp"
#include "diagnosis/next_test/thermal_forecast.hpp"

namespace ballbar {

struct ContinuedColumn {
  Forecast forecast;
  std::vector<double> residual;  // of the longest run, without gaps
  double resolution = 0.0;
  double mean = 0.0, at_rest = 0.0, turning = 0.0;
};

struct PlannedInputs {
  Series none;                           // all columns of the data but those of the target, without rows
  std::vector<ContinuedColumn> columns;  // as in `none`
  std::vector<double> time_s;            // of the longest run, from 0
  bool has_speed = false;
  double turning_rpm = 0.0;
};

// With several runs the longest provides the random variation of a column.
PlannedInputs planned_inputs(const Series& data, std::string_view target);

// The columns from time 0, one row per schedule.reading_s.
Series inputs_under(const Schedule& schedule, const PlannedInputs& planned, std::mt19937_64& random);

// The rows of a run from rest behind those of the data: the columns of the data that the run has.
Series with_run(Series data, const Series& run);

// The first speed column that is not always at rest; nullptr: none.
const Column* first_speed(const Series& data);

}  // namespace ballbar
