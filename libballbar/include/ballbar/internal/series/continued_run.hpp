// Rows that belong to the run of a fit, or follow it: the effects run on from the rows of the fit.
//
// Temperatures are relative to the first row of a run, and effects with a time constant start there at rest. A part of
// the run, or what follows it, is therefore predicted together with the run.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ballbar/series/series.hpp"

namespace ballbar {

struct ContinuedRun {
  Series series;               // the inputs over the rows of the run, and over the rows of the other that the run lacks
  std::vector<double> time_s;  // of each row of the other in `series`; NaN: before the first row of the run
  double pause_s = 0.0;        // from the last row of the run to the first row of the other; 0: they overlap
};

// `inputs`: the columns that matter. clock_s: time 0 of the other on the clock of the run, in s.
//
// The other is a part of the run if at common times all inputs are equal (to 1e-6 of their size), and between the rows
// of the run, at most 10 usual steps apart, they differ from the line on average by at most twice the step between
// these rows. It follows the run if it begins at most 8 h, or 10 usual steps, after its last row. nullopt: it is
// another run, or it lacks an input.
std::optional<ContinuedRun> continued_run(const Series& run, const Series& other,
                                          const std::vector<std::string>& inputs, double clock_s = 0.0);

}  // namespace ballbar
