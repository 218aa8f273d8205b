#include "fit/far_readings.hpp"

#include <algorithm>
#include <cmath>

#include "numerics/median.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kReach = 3;          // values on either side
constexpr double kOff = 6.0;               // sigma
constexpr double kMedianOfChange = 0.954;  // sigma, of two independent normal values

}  // namespace

std::vector<std::size_t> far_readings(const std::vector<double>& readings) {
  std::vector<std::size_t> row, far;
  std::vector<double> values;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    if (std::isnan(readings[i])) continue;
    row.push_back(i);
    values.push_back(readings[i]);
  }
  const std::size_t n = values.size();
  if (n < 4 * kReach) return far;
  std::vector<double> off, changes, about(2 * kReach + 1);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < about.size(); ++k)
      about[k] = values[std::min(n - 1, i + k < kReach ? 0 : i + k - kReach)];
    off.push_back(values[i] - median(about));
    if (i > 0) changes.push_back(std::abs(values[i] - values[i - 1]));
  }
  const double sigma = std::max(median_sigma(off), median(std::move(changes)) / kMedianOfChange);
  if (!(sigma > 0.0)) return far;
  for (std::size_t i = 0; i < n; ++i) {
    if (std::abs(off[i]) > kOff * sigma) far.push_back(row[i]);
  }
  return far;
}

}  // namespace ballbar
