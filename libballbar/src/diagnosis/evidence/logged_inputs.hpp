// What the inputs did, as far as a log tells: a log holds, rounds, and is late.
//
//   stepped     speed and load: between two rows at which it differs, an input was the old value and then the new one.
//               Drawn as a step in the middle of the time in which it may have happened, which is one sample of the
//               logger: the rows for which a value is held, or of a straight line between two samples
//   continuous  temperatures: of a coarse column (few values, long runs of the same) the smoothest curve that the runs
//               allow, by a Kalman smoother of an integrated random walk; of one that is held, through the first of
//               each run
#pragma once

#include <cstddef>
#include <string>
#include <vector>

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
  double sample_s = 0.0;    // of its logger
  std::vector<Jump> jumps;  // of a continuous one its largest changes, on an unknown way
};

struct LoggedInputs {
  Series series;  // the data, with these inputs drawn anew
  std::vector<LoggedInput> inputs;
};

// targets: columns that are no inputs. Rows and names stay.
LoggedInputs logged_inputs(const Series& data, const std::vector<std::string>& targets);

// The column with this jump a sample of its width earlier (shift = 1) or later (-1), 0 < |shift| <= 1.
std::vector<double> with_jump_moved(const std::vector<double>& values, const Jump& jump, bool earlier);

}  // namespace ballbar
