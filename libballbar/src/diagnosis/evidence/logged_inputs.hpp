// Reconstructs the true inputs from a log, because a logger holds, rounds and delays values.
//
//   stepped     speed, load, and what is held and switched (signal_kind.hpp): between two rows with different values,
//               the input steps from the old to the new value. The step is placed in the middle of the possible
//               interval, which is one sample of the logger: the rows over which a value is held, or the rows of a
//               straight line between two samples
//   continuous  other columns as they are, but temperatures: for a coarse one (its runs of equal values differ by one
//               resolution) a curve through the changes between its runs, by a Kalman smoother of an integrated random
//               walk; for a held column through the first row of each run. Jumps of the zero of a sensor on a body are
//               taken out. Those that measure the same quantity get the mean of their curves, so that the noise of a
//               sensor does not choose among them
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "ballbar/diagnosis/signatures/search.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

// A change of a stepped input: `before` up to row `first`, `after` from row `last` on.
struct Jump {
  std::size_t first = 0, last = 0;  // first < last
  double before = 0.0, after = 0.0;
};

struct LoggedInput {
  std::string column;
  bool is_stepped = false;
  std::size_t held = 1;             // rows for which its logger holds a value
  double late_s = 0.0;              // its logger's sample: by so much its clock may be late or early
  std::vector<Jump> jumps;          // of a stepped input
  bool is_stuck = false;            // else saturated
  std::vector<std::size_t> at_end;  // rising rows in which its sensor is saturated or stands still
};

struct LoggedInputs {
  Series series;  // the data with the reconstructed inputs
  std::vector<LoggedInput> inputs;
  std::vector<EqualColumns> equal;
};

// targets: columns that are not inputs. Rows and names do not change.
LoggedInputs logged_inputs(const Series& data, const std::vector<std::string>& targets, const Tuning& tuning = {});

// The column with this jump moved to the beginning of its sample (earlier) or to its end.
std::vector<double> with_jump_moved(const std::vector<double>& values, const Jump& jump, bool earlier);

}  // namespace ballbar
