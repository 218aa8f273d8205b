#include "drift/sample_agreement.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

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
  axis.deviation = Deviation{axis.time_s[from],      axis.time_s[to],   to + 1 == axis.time_s.size(),
                             axis.difference[worst], axis.sigma[worst], axis.time_s[worst]};
}

}  // namespace ballbar
