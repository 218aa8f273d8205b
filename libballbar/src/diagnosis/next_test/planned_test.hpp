// The menu of next_test.hpp: what each test would look like as data.
//
// A test on a drift is a plan of speeds, room and coolant over 2 to 4 h, begun cold and at rest, read as often as the
// data were. Speed columns are as planned. The room (columns of role ambient) stays at its mean but for a step of 3 K,
// events stay at their means, loads at those that they had at rest and turning, but for a step to twice as much. Every
// other column follows speed, room and coolant as it did in the data (thermal_forecast.hpp); one that follows nothing
// is `unknown`. A repetition takes the columns of the data themselves.
//
// A test on recordings drives the circles of the data again the other way round, at another feed or radius.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "ballbar/series/series.hpp"

namespace ballbar {

struct PlannedTest {
  std::string name;               // "stop and go"
  std::string doing;              // "1 h at rest, 1 h at 5000 rpm, 1 h at rest": what follows its name and a colon
  Series inputs;                  // columns of the data but the target's, from time 0
  std::vector<std::size_t> rows;  // of `inputs`, rising: where a reading is taken
  double duration_s = 0.0;
  bool new_set_up = false;                    // what depends on time alone starts again; else it goes on
  std::vector<std::string> unknown;           // columns held at their mean, as they follow neither speed nor room
  std::vector<std::string> forecast;          // phrases of the columns that are predicted: "T_body_degC (R2 = 0.97)"
  std::vector<std::string> forecast_columns;  // these
};

// rows: of the data, rising, with a reading of the target; at least two.
std::vector<PlannedTest> drift_tests(const Series& data, const std::string& target,
                                     const std::vector<std::size_t>& rows);

std::vector<PlannedTest> recording_tests(const Series& trace, const std::string& target,
                                         const std::vector<std::size_t>& rows);

}  // namespace ballbar
