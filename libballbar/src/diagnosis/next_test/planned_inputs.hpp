// What a logger would show in a test that nobody has run yet.
//
// Speeds are as scheduled; a load follows the speed as in the data, times what the schedule says. The room goes on as
// it did: the data's own values from a drawn moment on, forwards and backwards, with the steps that are scheduled.
// Every other column follows speed, room and coolant as it did (thermal_forecast.hpp), and what that leaves of it in
// the data goes on in the same way; a column that follows nothing (R2 < 0.5) is its own values alone. All are rounded
// as logged. Columns that are one in the data stay one.
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
  // Refers to the data. Of several runs the longest tells how a column wanders.
  PlannedInputs(const Series& data, std::string target);

  // All columns of the data but the target's, from time 0, a row each schedule.reading_s.
  Series under(const Schedule& schedule, std::mt19937_64& random) const;

 private:
  struct Wandering {
    std::vector<double> values;  // of the longest run, no gaps
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

// The first column of speed that is not at rest all the time; nullptr: none.
const Column* first_speed(const Series& data);

}  // namespace ballbar
