// What a logger makes of a true track: rows, late, held, ramped, noisy and rounded.
#pragma once

#include <vector>

#include "plan.hpp"

namespace ballbar::verdicts {

enum class Logging {
  exact,   // each row has the value of its moment
  held,    // the sensor is asked every so many seconds, the value held until the next
  ramped,  // likewise, a straight line between the values
};

struct Conventions {
  Logging logging = Logging::exact;
  std::size_t row_s = 15;     // from row to row
  std::size_t every_s = 60;   // of `held` and `ramped`: from asking to asking, the first at a random phase
  double most_late = 0.0;     // an input's clock is late by up to so many of its samples, drawn evenly
  double kelvin_step = 0.01;  // temperatures are rounded to it; 0: not
  double sensor_noise_K = 0.01;
};

// Rows at 0, row_s ... up to the span of the plan, s.
std::vector<double> rows_of(const Plan& plan, std::size_t row_s);

// Of one column, s.
struct Clock {
  double late_s = 0.0;   // the same in every run of a machine
  double phase_s = 0.0;  // of the first sample; `exact` has those of the rows
};
Clock drawn_clock(const Conventions& conventions, Chance& chance);

// The column of that track. Temperatures have noise and steps; a speed is whole revolutions, a load whole watts.
std::vector<double> logged(const Track& track, Quantity quantity, const std::vector<double>& time_s,
                           const Conventions& conventions, const Clock& clock, Chance& chance);
std::vector<double> logged(const Track& track, Quantity quantity, const std::vector<double>& time_s,
                           const Conventions& conventions, Chance& chance);

// The track at the rows as it is.
std::vector<double> at_rows(const Track& track, const std::vector<double>& time_s);

}  // namespace ballbar::verdicts
