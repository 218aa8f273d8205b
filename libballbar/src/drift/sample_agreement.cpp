#include "drift/sample_agreement.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "numerics/tails.hpp"

namespace ballbar {
namespace {

constexpr double kChance = 0.01;

// P(at least k of n samples beyond 2 sigma) where half of each variance is an error that all share: that of the zero.
// The shared part c is integrated over; beyond 2 sigma is then |sqrt(1/2) c + sqrt(1/2) e| > 2 of the own part e.
double chance_of_beyond(std::size_t k, std::size_t n) {
  if (k == 0) return 1.0;
  constexpr double kStep = 0.05, kFarthest = 6.0;
  double probability = 0.0;
  for (double c = -kFarthest; c <= kFarthest; c += kStep) {
    const double density = std::exp(-0.5 * c * c) / std::sqrt(2.0 * std::numbers::pi);
    const double above = 0.5 * std::erfc((2.0 - std::sqrt(0.5) * c) / std::sqrt(0.5) / std::numbers::sqrt2);
    const double below = 0.5 * std::erfc((2.0 + std::sqrt(0.5) * c) / std::sqrt(0.5) / std::numbers::sqrt2);
    const double p = std::clamp(above + below, 1e-12, 1.0 - 1e-12);
    probability += density * kStep * binomial_upper_tail(k, n, p);
  }
  return probability;
}

double deviation_in_sigma(const AxisComparison& axis, std::size_t i) {
  if (!std::isfinite(axis.sigma[i]) || axis.difference[i] == 0.0) return 0.0;
  return std::abs(axis.difference[i]) / axis.sigma[i];  // infinite where sigma is 0
}

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

void decide_by_samples(AxisComparison& axis, double reference_s) {
  std::size_t worst = 0;
  for (std::size_t i = 0; i < axis.time_s.size(); ++i) {
    if (axis.time_s[i] == reference_s || !std::isfinite(axis.sigma[i])) continue;
    ++axis.counted;
    if (deviation_in_sigma(axis, i) <= 2.0) ++axis.within;
    if (deviation_in_sigma(axis, i) > deviation_in_sigma(axis, worst)) worst = i;
  }
  if (axis.counted == 0) return;
  const double z = deviation_in_sigma(axis, worst);
  const double largest_by_chance =
      -std::expm1(static_cast<double>(axis.counted) * std::log1p(-std::erfc(z / std::numbers::sqrt2)));
  const bool too_many = chance_of_beyond(axis.counted - axis.within, axis.counted) < kChance;
  axis.samples_agree = !too_many && largest_by_chance >= kChance;
  axis.agreement = axis.samples_agree ? Agreement::agrees : Agreement::disagrees;
  if (z <= 2.0) return;
  const auto beyond = [&](std::size_t i) {
    return deviation_in_sigma(axis, i) > 2.0 && (axis.difference[i] > 0.0) == (axis.difference[worst] > 0.0);
  };
  std::size_t from = worst, to = worst;
  while (from > 0 && beyond(from - 1)) --from;
  while (to + 1 < axis.time_s.size() && beyond(to + 1)) ++to;
  axis.deviation = Deviation{
      axis.time_s[from],  axis.time_s[to], to + 1 == axis.time_s.size(), axis.difference[worst], axis.sigma[worst],
      axis.time_s[worst], axis.unit};
}

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
