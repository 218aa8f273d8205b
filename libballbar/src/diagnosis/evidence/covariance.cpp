#include "diagnosis/evidence/covariance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "ballbar/diagnosis/thresholds.hpp"

namespace ballbar {
namespace {

double usual_step_s(std::span<const double> time_s) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < time_s.size(); ++i) {
    if (time_s[i] > time_s[i - 1]) steps.push_back(time_s[i] - time_s[i - 1]);
  }
  if (steps.empty()) return 1.0;
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle;
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

// New noise in a step over the white one, e^log_ratio.
Covariance noise_with(double step_s, double memory_s, double log_ratio) {
  const double ratio = std::exp(log_ratio) / -std::expm1(-2.0 * step_s / memory_s);
  Covariance result;
  result.white = 1.0 / (1.0 + ratio);
  result.correlated = ratio / (1.0 + ratio);
  result.time_s = memory_s;
  return result;
}

double between(double low, double high, std::size_t i, std::size_t count) {
  return low * std::pow(high / low, (static_cast<double>(i) + 0.5) / static_cast<double>(count));
}

}  // namespace

std::vector<Covariance> covariance_grid(std::span<const double> time_s, bool with_slow) {
  std::vector<Covariance> grid;
  if (time_s.size() < kFewestForMemory) return {Covariance{}};
  const double step_s = usual_step_s(time_s), span_s = span_of_time_s(time_s);
  const double shortest_s = 0.5 * step_s, longest_s = std::max(2.0 * step_s, span_s / 3.0);
  for (std::size_t i = 0; i < kMemories; ++i) {
    for (const double ratio : {-5.0, -3.0, -1.8, -0.6, 0.6, 1.8, 3.0, 5.0}) {
      grid.push_back(noise_with(step_s, between(shortest_s, longest_s, i, kMemories), ratio));
    }
  }
  const std::size_t noises = grid.size();
  for (Covariance& one : grid) {
    one.log_prior = std::log((with_slow ? 1.0 - kPriorOfDiscrepancy : 1.0) / static_cast<double>(noises));
  }
  if (!with_slow) return grid;
  const double slow_longest_s = std::max(2.0 * step_s, span_s / 30.0);
  for (std::size_t i = 0; i < kMemoriesBesideSlow; ++i) {
    for (const double ratio : {-5.0, 1.0}) {
      for (const double length : {1.0 / 40.0, 1.0 / 12.0, 1.0 / 4.0}) {
        for (const double sigma : {0.8, 2.5, 8.0}) {
          Covariance one = noise_with(step_s, between(shortest_s, slow_longest_s, i, kMemoriesBesideSlow), ratio);
          one.slow = sigma * sigma;
          one.slow_time_s = length * span_s;
          grid.push_back(one);
        }
      }
    }
  }
  const double slow_prior = std::log(kPriorOfDiscrepancy / static_cast<double>(grid.size() - noises));
  for (std::size_t i = noises; i < grid.size(); ++i) grid[i].log_prior = slow_prior;
  return grid;
}

// x = (s, m, m'): the memory, an Ornstein-Uhlenbeck process; the discrepancy, Matern 3/2, with its slope. H = (1, 1,
// 0).
CovarianceFilter::CovarianceFilter(const Covariance& covariance, std::span<const double> time_s,
                                   std::span<const double> relative_variance)
    : has_slow_(covariance.slow > 0.0), has_memory_(covariance.correlated > 0.0) {
  using Matrix = Eigen::Matrix3d;
  const double lambda = has_slow_ ? std::sqrt(3.0) / covariance.slow_time_s : 1.0;
  const Eigen::Vector3d stationary(covariance.correlated, covariance.slow, lambda * lambda * covariance.slow);
  Matrix p = stationary.asDiagonal(), before = p, transition = Matrix::Zero(), added = p;
  double last_step = -1.0, last_variance = -1.0;
  bool settled = false;
  rows_.resize(time_s.size());
  for (std::size_t i = 0; i < time_s.size(); ++i) {
    const double variance =
        std::max(1e-12, covariance.white * (relative_variance.empty() ? 1.0 : relative_variance[i]));
    const bool starts = i == 0 || time_s[i] < time_s[i - 1];
    const double step = starts ? -1.0 : time_s[i] - time_s[i - 1];
    const bool same_step = !starts && std::abs(step - last_step) <= 1e-9 * step;
    if (same_step && settled && variance == last_variance) {
      rows_[i] = rows_[i - 1];
      log_determinant_ -= 2.0 * std::log(rows_[i].scale);
      continue;
    }
    if (!same_step) {
      transition.setZero();
      if (!starts) {
        const double e = std::exp(-lambda * step);
        transition(0, 0) = has_memory_ ? std::exp(-step / covariance.time_s) : 0.0;
        transition(1, 1) = e * (1.0 + lambda * step);
        transition(1, 2) = e * step;
        transition(2, 1) = -e * lambda * lambda * step;
        transition(2, 2) = e * (1.0 - lambda * step);
      }
      const Matrix still = stationary.asDiagonal();
      added = still - transition * still * transition.transpose();
    }
    const Matrix now = transition * p * transition.transpose() + added;
    const Eigen::Vector3d ph = now.col(0) + now.col(1);
    const double s = ph[0] + ph[1] + variance;
    const Eigen::Vector3d gain = ph / s;
    p = now - gain * ph.transpose();
    settled = same_step && variance == last_variance && (now - before).cwiseAbs().maxCoeff() <= 1e-12;
    before = now;
    last_step = step;
    last_variance = variance;
    rows_[i] = {transition(0, 0), transition(1, 1), transition(1, 2), transition(2, 1),  transition(2, 2),
                gain[0],          gain[1],          gain[2],          1.0 / std::sqrt(s)};
    log_determinant_ += std::log(s);
  }
}

void CovarianceFilter::apply(std::size_t first, RowMajorBlock block, RowMajorMatrix& state) const {
  for (Eigen::Index i = 0; i < block.rows(); ++i) {
    const Row& row = rows_[first + static_cast<std::size_t>(i)];
    auto values = block.row(i).array();
    auto s = state.row(0).array();
    if (has_slow_) {
      auto m = state.row(1).array();
      auto slope = state.row(2).array();
      const Eigen::Index columns = block.cols();
      double* v = &block(i, 0);
      for (Eigen::Index k = 0; k < columns; ++k) {
        const double s0 = row.decay * s(k);
        const double m0 = row.f00 * m(k) + row.f01 * slope(k);
        const double m1 = row.f10 * m(k) + row.f11 * slope(k);
        const double innovation = v[k] - s0 - m0;
        s(k) = s0 + row.k0 * innovation;
        m(k) = m0 + row.k1 * innovation;
        slope(k) = m1 + row.k2 * innovation;
        v[k] = innovation * row.scale;
      }
    } else if (has_memory_) {
      s *= row.decay;
      values -= s;
      s += row.k0 * values;
      values *= row.scale;
    } else {
      values *= row.scale;
    }
  }
}

}  // namespace ballbar
