#include "drift/sample_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

namespace ballbar {
namespace {

double mean(std::span<const double> values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

std::optional<double> correlation(const std::vector<double>& a, const std::vector<double>& b) {
  const double mean_a = mean(a), mean_b = mean(b);
  double aa = 0.0, bb = 0.0, ab = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    aa += (a[i] - mean_a) * (a[i] - mean_a);
    bb += (b[i] - mean_b) * (b[i] - mean_b);
    ab += (a[i] - mean_a) * (b[i] - mean_b);
  }
  if (!(aa > 0.0 && bb > 0.0)) return std::nullopt;
  return ab / std::sqrt(aa * bb);
}

}  // namespace

void describe_samples(AxisComparison& axis, double reference_s) {
  const std::size_t n = axis.difference.size();
  const auto [low, high] = std::minmax_element(axis.b.begin(), axis.b.end());
  const double range = *high - *low;
  double squares = 0.0, relative = 0.0, expected = 0.0, absolute = 0.0;
  std::size_t relative_samples = 0;
  std::vector<double> moved;  // differences, the reference left out: it is 0 by definition
  for (std::size_t i = 0; i < n; ++i) {
    const double d = axis.difference[i];
    if (std::abs(d) > std::abs(axis.largest) || i == 0) {
      axis.largest = d;
      axis.largest_s = axis.time_s[i];
    }
    if (axis.time_s[i] == reference_s) continue;
    moved.push_back(d);
    squares += d * d;
    absolute += std::abs(d);
    if (std::abs(axis.b[i]) > range / 10.0) {
      ++relative_samples;
      relative += std::abs(d / axis.b[i]);
      expected += std::sqrt(2.0 / std::numbers::pi) * axis.sigma[i] / std::abs(axis.b[i]);
    }
  }
  const auto count = static_cast<double>(moved.size());
  axis.rmse = std::sqrt(squares / count);
  axis.bias = mean(moved);
  if (moved.size() > 1) {
    double variance = 0.0;
    for (const double d : moved) variance += (d - axis.bias) * (d - axis.bias);
    const double sd = std::sqrt(variance / (count - 1.0));
    axis.limit_low = axis.bias - 1.96 * sd;
    axis.limit_high = axis.bias + 1.96 * sd;
  }
  if (range > 0.0) axis.range_deviation = absolute / count / range;
  if (relative_samples > 0) {
    axis.mean_relative_deviation = relative / static_cast<double>(relative_samples);
    if (std::isfinite(expected)) {
      axis.expected_relative_deviation = expected / static_cast<double>(relative_samples);
      if (relative > 0.0) axis.explained_share = std::min(1.0, expected / relative);
    }
  }
  axis.correlation = correlation(axis.a, axis.b);
}

}  // namespace ballbar
