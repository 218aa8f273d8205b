// What an error would have been with a model on line: a compensation run over recorded signals, causal.
//
// Rows are all times of the signals, in order; a column's value in a row is that of the last row of its own series, at
// most gap_s old: a gap there is a gap, as it was when it was recorded. The error at a time is met by the offset of the
// last row before that time, so that nothing of the same moment or later is used:
//
//   before_i = measured(t_i) - measured(t_0)
//   after_i  = before_i + offset(last row before t_i) - offset(last row before t_0)
//
// t_0 is the first value of the target, which is where the machine is zeroed: it is left out of RMS and largest.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "ballbar/compensation/compensated_axes.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

// How much smaller a compensation made an error, and how sure that is.

// Of n values: what is compared from before to after.
enum class ErrorSize { mean_of_sizes, root_mean_square };

// share = 1 - size(after) / size(before); 0.7: 70 % less. sigma by leaving out each stretch of `stretch` values in turn
// (delete-a-group jackknife), a stretch being twice as long as what is left after stays alike: the lag at which its
// autocorrelation falls below 0.2, at least 1 value, at most a fifth of all.
struct Reduction {
  double before_um = 0.0;
  double after_um = 0.0;
  double share = 0.0;  // NaN where there was no error before
  double sigma = 0.0;  // NaN: fewer than 3 values
  std::size_t stretch = 1;
};

// n >= 1 errors in um before and as many after, pair by pair, in order of time.
Reduction reduction_of(std::span<const double> before_um, std::span<const double> after_um, ErrorSize size);

struct ReplayedAxis {
  std::string name;
  std::string target;
  std::vector<double> time_s, before_um, after_um, offset_um;  // n values of the target, the first at t_0
  Reduction reduction;                                         // of the root mean square
  std::array<std::size_t, kHoldKinds> rows_held{};             // by Hold; those under none were not held
  std::string most_held_by;                                    // column that held most rows; empty: none did
  std::size_t rows_limited = 0;
};

struct Replay {
  std::size_t rows = 0;
  std::vector<ReplayedAxis> axes;
};

// Throws Error: a column that no signal has (with the nearest), a target that `measured` lacks or that has fewer than
// two values after the first row of the signals, and what CompensatedAxes throws.
Replay replay_of(const std::vector<CompensatedAxis>& axes, const CompensationLimits& limits,
                 const std::vector<Series>& signals, const Series& measured);

}  // namespace ballbar
