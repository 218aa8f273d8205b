#include "noise/noise_grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "ballbar/numerics/order_statistic.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kFewestForMemory = 30;  // rows; with fewer the scatter is white
constexpr std::size_t kMemories = 7;
constexpr std::array<double, 3> kWhiteOverNew{2.5, 0.3, -4.0};  // ln of variances, of the noise in a step
constexpr double kBetweenRatios = 1.0;                          // of these, between two of the grid
constexpr std::array<double, 3> kSlowLengths{1.0 / 40.0, 1.0 / 12.0, 1.0 / 4.0};  // of the time
constexpr std::array<double, 3> kSlowSizes{0.8, 2.5, 8.0};  // standard deviation, in units of the noise

double usual_step_s(std::span<const double> time_s) {
  const double step_s = median_step_s(time_s);
  return step_s > 0.0 ? step_s : 1.0;
}

// The longest stretch in which time goes on.
double span_of_time_s(std::span<const double> time_s) {
  double longest = 0.0, begin = time_s.empty() ? 0.0 : time_s.front();
  for (std::size_t i = 1; i < time_s.size(); ++i) {
    if (time_s[i] < time_s[i - 1]) begin = time_s[i];
    longest = std::max(longest, time_s[i] - begin);
  }
  return longest;
}

double longest_memory_s(double step_s, std::span<const double> time_s) {
  return std::max(3.0 * step_s, span_of_time_s(time_s) / 6.0);
}

}  // namespace

std::vector<Covariance> noise_grid(std::span<const double> time_s) {
  std::vector<Covariance> grid{Covariance{}};
  if (time_s.size() < kFewestForMemory) return grid;
  const double step_s = usual_step_s(time_s), longest_s = longest_memory_s(step_s, time_s);
  for (std::size_t i = 0; i < kMemories; ++i) {
    for (const double log_white : kWhiteOverNew) {
      const double share = static_cast<double>(i) / static_cast<double>(kMemories - 1);
      grid.push_back(with_memory(1.0, log_white, step_s, step_s * std::pow(longest_s / step_s, share)));
    }
  }
  for (Covariance& one : grid) one.log_prior = -std::log(static_cast<double>(grid.size()));
  return grid;
}

std::vector<Covariance> noises_about(const Covariance& noise, std::span<const double> time_s) {
  std::vector<Covariance> about;
  if (!(noise.correlated > 0.0)) return about;
  const double step_s = usual_step_s(time_s), longest_s = longest_memory_s(step_s, time_s);
  const double third = std::pow(longest_s / step_s, 1.0 / static_cast<double>(3 * (kMemories - 1)));
  const double log_white = -std::log(noise.correlated / noise.white * -std::expm1(-2.0 * step_s / noise.time_s));
  for (const double factor : {1.0 / third, 1.0, third}) {
    for (const double more : {-kBetweenRatios, 0.0, kBetweenRatios}) {
      if (factor == 1.0 && more == 0.0) continue;
      about.push_back(with_memory(1.0, log_white - more, step_s, noise.time_s * factor));
      about.back().log_prior = noise.log_prior;
    }
  }
  return about;
}

std::vector<Covariance> with_discrepancy(const Covariance& noise, std::span<const double> time_s) {
  std::vector<Covariance> grid;
  if (time_s.size() < kFewestForMemory) return grid;
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
