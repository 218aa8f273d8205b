// Simulates the logged inputs of a planned test.
//
// Speeds are as scheduled. A load follows the speed as in the data, times the factor of the schedule. The room
// continues with the values of the data from a random moment on, forwards and backwards, plus the scheduled steps.
// Every other column follows speed, room and coolant as in the data (thermal_forecast.hpp), with its residual continued
// like the room; a column that follows nothing (R2 < 0.5) continues with its own values. All values are rounded as
// logged. Equal columns stay equal.
#pragma once

#include <random>
#include <string>
#include <vector>

#include "ballbar/diagnosis/next_test/schedule.hpp"
#include "ballbar/series/series.hpp"
#include "diagnosis/next_test/thermal_forecast.hpp"

namespace ballbar {

class PlannedInputs {
 public:
  // Keeps a reference to the data. With several runs the longest provides the random variation of a column.
  PlannedInputs(const Series& data, std::string target);

  // All columns of the data but those of the target, from time 0, one row per schedule.reading_s.
  Series under(const Schedule& schedule, std::mt19937_64& random) const;

 private:
  struct Wandering {
    std::vector<double> values;  // of the longest run, without gaps
    double resolution = 0.0;
    double mean = 0.0, at_rest = 0.0, turning = 0.0;
  };
  std::vector<double> wandered(std::size_t column, const std::vector<double>& time_s, double from_s) const;
  std::vector<double> loaded(std::size_t column, const Schedule& schedule, const Drives& drives) const;

  const Series& data_;
  std::string target_;
  std::vector<double> time_s_;  // of the longest run, from 0
  std::vector<Wandering> columns_;
  std::vector<Forecast> forecasts_;
  bool has_room_ = false, has_coolant_ = false, has_speed_ = false;
  double turning_rpm_ = 0.0;
};

// The first speed column that is not always at rest; nullptr: none.
const Column* first_speed(const Series& data);

}  // namespace ballbar
