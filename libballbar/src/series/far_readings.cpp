#include "ballbar/internal/series/far_readings.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "numerics/median.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kReach = 3;          // values on either side
constexpr double kOff = 10.0;              // sigma
constexpr double kBack = 0.25;             // of the smallest deviation
constexpr double kMedianOfChange = 0.954;  // sigma, of two independent normal values

double sigma_of(const std::vector<double>& values, const std::vector<double>& off) {
  std::vector<double> changes;
  for (std::size_t i = 1; i < values.size(); ++i) changes.push_back(std::abs(values[i] - values[i - 1]));
  return std::max(median_sigma(off), median(std::move(changes)) / kMedianOfChange);
}

// Whether the values before first and from end on are those of one level that all between are far from.
bool come_back(const std::vector<double>& values, std::size_t first, std::size_t end) {
  std::vector<double> about(values.begin() + static_cast<std::ptrdiff_t>(first > kReach ? first - kReach : 0),
                            values.begin() + static_cast<std::ptrdiff_t>(first));
  about.insert(about.end(), values.begin() + static_cast<std::ptrdiff_t>(end),
               values.begin() + static_cast<std::ptrdiff_t>(std::min(values.size(), end + kReach)));
  const double level = median(about);
  const auto off = [&](double value) { return std::abs(value - level); };
  double least = off(values[first]), most = 0.0;
  for (std::size_t i = first; i < end; ++i) least = std::min(least, off(values[i]));
  for (const double value : about) most = std::max(most, off(value));
  return most <= kBack * least;
}

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
  std::vector<double> off;
  off.reserve(n);
  for (std::size_t i = 0; i < n; ++i) {
    if (i >= kReach && i + kReach < n) {
      std::array<double, 2 * kReach + 1> about;
      std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(i - kReach), about.size(), about.begin());
      std::nth_element(about.begin(), about.begin() + kReach, about.end());
      off.push_back(values[i] - about[kReach]);
      continue;
    }
    const auto from = static_cast<std::ptrdiff_t>(i > kReach ? i - kReach : 0);
    const auto end = static_cast<std::ptrdiff_t>(std::min(n, i + kReach + 1));
    off.push_back(values[i] - median(std::vector<double>(values.begin() + from, values.begin() + end)));
  }
  const double least = kOff * sigma_of(values, off);
  if (!(least > 0.0)) return far;
  for (std::size_t first = 0, end = 0; first < n; first = end + 1) {
    for (end = first; end < n && std::abs(off[end]) > least;) ++end;
    const bool is_inside = first > 0 && end < n;  // a start is no fault
    if (end == first || end - first > kReach || !is_inside || !come_back(values, first, end)) continue;
    far.insert(far.end(), row.begin() + static_cast<std::ptrdiff_t>(first),
               row.begin() + static_cast<std::ptrdiff_t>(end));
  }
  return far;
}

}  // namespace ballbar
