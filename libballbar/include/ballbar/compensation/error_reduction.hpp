// How much smaller a compensation made an error, and how sure that is.
#pragma once

#include <cstddef>
#include <span>

namespace ballbar {

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

}  // namespace ballbar
