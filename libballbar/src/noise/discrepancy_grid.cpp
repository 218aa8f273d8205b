#include "noise/discrepancy_grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace ballbar {
namespace {

constexpr std::size_t kFewestForDiscrepancy = 30;                                 // rows
constexpr std::array<double, 3> kSlowLengths{1.0 / 40.0, 1.0 / 12.0, 1.0 / 4.0};  // of the time
constexpr std::array<double, 3> kSlowSizes{0.8, 2.5, 8.0};  // standard deviation, in units of the noise

}  // namespace

double span_of_time_s(std::span<const double> time_s) {
  double longest = 0.0, begin = time_s.empty() ? 0.0 : time_s.front();
  for (std::size_t i = 1; i < time_s.size(); ++i) {
    if (time_s[i] < time_s[i - 1]) begin = time_s[i];
    longest = std::max(longest, time_s[i] - begin);
  }
  return longest;
}

std::vector<Covariance> with_discrepancy(const Covariance& noise, std::span<const double> time_s) {
  std::vector<Covariance> grid;
  if (time_s.size() < kFewestForDiscrepancy) return grid;
  const double span_s = span_of_time_s(time_s);
  for (const double length : kSlowLengths) {
    for (const double sigma : kSlowSizes) {
      Covariance one = noise;
      one.slow = sigma * sigma;
      one.slow_time_s = length * span_s;
      one.log_prior -= std::log(static_cast<double>(kSlowLengths.size() * kSlowSizes.size()));
      grid.push_back(one);
    }
  }
  return grid;
}

}  // namespace ballbar
