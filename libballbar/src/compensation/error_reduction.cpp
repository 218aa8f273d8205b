#include "ballbar/compensation/error_reduction.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

#include "numerics/not_finite.hpp"

namespace ballbar {
namespace {

double size_of(double error_um, ErrorSize size) {
  return size == ErrorSize::mean_of_sizes ? std::abs(error_um) : error_um * error_um;
}

double sum_of(std::span<const double> errors_um, ErrorSize size) {
  double sum = 0.0;
  for (const double error_um : errors_um) sum += size_of(error_um, size);
  return sum;
}

double share_of(double before, double after, ErrorSize size) {
  if (!(before > 0.0)) return kUnknown;
  return 1.0 - (size == ErrorSize::mean_of_sizes ? after / before : std::sqrt(after / before));
}

// Twice the lag at which the values are no longer alike.
std::size_t stretch_of(std::span<const double> values) {
  const std::size_t n = values.size(), longest = std::max<std::size_t>(1, n / 5);
  double mean = 0.0, square = 0.0;
  for (const double value : values) mean += value / static_cast<double>(n);
  for (const double value : values) square += (value - mean) * (value - mean);
  for (std::size_t lag = 1; lag < longest; ++lag) {
    double product = 0.0;
    for (std::size_t i = lag; i < n; ++i) product += (values[i] - mean) * (values[i - lag] - mean);
    if (!(product > 0.2 * square)) return std::min(longest, lag == 1 ? lag : 2 * lag);
  }
  return longest;
}

// sigma^2 = (g - 1) / g sum (share without stretch j - their mean)^2, g stretches
double jackknife(std::span<const double> before_um, std::span<const double> after_um, ErrorSize size,
                 std::size_t stretch) {
  const std::size_t n = before_um.size();
  if (n < 3) return kUnknown;
  const double before = sum_of(before_um, size), after = sum_of(after_um, size);
  std::vector<double> without;
  double mean = 0.0;
  for (std::size_t from = 0; from < n; from += stretch) {
    const std::size_t count = std::min(stretch, n - from);
    without.push_back(share_of(before - sum_of(before_um.subspan(from, count), size),
                               after - sum_of(after_um.subspan(from, count), size), size));
    mean += without.back();
  }
  const auto groups = static_cast<double>(without.size());
  mean /= groups;
  double square = 0.0;
  for (const double share : without) square += (share - mean) * (share - mean);
  return std::sqrt((groups - 1.0) / groups * square);
}

}  // namespace

Reduction reduction_of(std::span<const double> before_um, std::span<const double> after_um, ErrorSize size) {
  assert(!before_um.empty() && before_um.size() == after_um.size());
  const auto n = static_cast<double>(before_um.size());
  const double before = sum_of(before_um, size), after = sum_of(after_um, size);
  const bool squares = size == ErrorSize::root_mean_square;
  const std::size_t stretch = stretch_of(after_um);
  return {squares ? std::sqrt(before / n) : before / n, squares ? std::sqrt(after / n) : after / n,
          share_of(before, after, size), jackknife(before_um, after_um, size, stretch), stretch};
}

}  // namespace ballbar
