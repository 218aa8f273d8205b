// Replays a compensation over recorded signals: the error that would have remained with the model on line.
//
// There is a row at every time of a signal, in order. The value of a column is that of the last row of its own series,
// at most gap_s old; gaps stay gaps. The replay is causal: the error at a time is compensated by the offset of the last
// row before that time.
//
//   before_i = measured(t_i) - measured(t_0)
//   after_i  = before_i + offset(last row before t_i) - offset(last row before t_0)
//
// t_0 is the time of the first value of the target, where the machine is zeroed. That value is not part of RMS and
// largest error.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "ballbar/compensation/compensated_axes.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

// The reduction of an error by a compensation, and its uncertainty.

// The size of n errors that is compared before and after.
enum class ErrorSize { mean_of_sizes, root_mean_square };

// share = 1 - size(after) / size(before); 0.7 means 70 % less. sigma comes from the delete-a-group jackknife with
// groups of `stretch` consecutive values. A group is twice as long as the lag at which the autocorrelation of the
// errors after falls below 0.2, at least 1 value and at most a fifth of all.
struct Reduction {
  double before_um = 0.0;
  double after_um = 0.0;
  double share = 0.0;  // NaN: no error before
  double sigma = 0.0;  // NaN: fewer than 3 values
  std::size_t stretch = 1;
};

// n >= 1 errors before and n errors after in um, pairwise, in order of time.
Reduction reduction_of(std::span<const double> before_um, std::span<const double> after_um, ErrorSize size);

struct ReplayedAxis {
  std::string name;
  std::string target;
  std::vector<double> time_s, before_um, after_um, offset_um;  // n values of the target, the first at t_0
  Reduction reduction;                                         // by the root mean square
  std::array<std::size_t, kHoldKinds> rows_held{};             // by Hold; rows under `none` were not held
  std::string most_held_by;                                    // the column that held most rows; empty: none
  std::size_t rows_limited = 0;
};

struct Replay {
  std::size_t rows = 0;
  std::vector<ReplayedAxis> axes;
};

// Throws Error: a column that no signal has (with the nearest name), a target that `measured` lacks or that has fewer
// than two values after the first row of the signals, and the errors of CompensatedAxes.
Replay replay_of(const std::vector<CompensatedAxis>& axes, const CompensationLimits& limits,
                 const std::vector<Series>& signals, const Series& measured);

}  // namespace ballbar
