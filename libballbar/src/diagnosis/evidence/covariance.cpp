#include "diagnosis/evidence/covariance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "ballbar/numerics/order_statistic.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kFewestForMemory = 30;  // rows; with fewer the scatter is white
constexpr std::size_t kMemories = 7;
constexpr std::array<double, 3> kNewOverWhite{-2.5, -0.3, 4.0};  // ln of variances, of the noise in a step
constexpr double kBetweenRatios = 1.0;                           // of these, between two of the grid
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

// New noise in a step over the white one, e^log_ratio.
Covariance noise_with(double step_s, double memory_s, double log_ratio) {
  const double ratio = std::exp(log_ratio) / -std::expm1(-2.0 * step_s / memory_s);
  Covariance result;
  result.white = 1.0 / (1.0 + ratio);
  result.correlated = ratio / (1.0 + ratio);
  result.time_s = memory_s;
  return result;
}

}  // namespace

std::vector<Covariance> noise_grid(std::span<const double> time_s) {
  std::vector<Covariance> grid{Covariance{}};
  if (time_s.size() < kFewestForMemory) return grid;
  const double step_s = usual_step_s(time_s), longest_s = longest_memory_s(step_s, time_s);
  for (std::size_t i = 0; i < kMemories; ++i) {
    for (const double log_ratio : kNewOverWhite) {
      const double share = static_cast<double>(i) / static_cast<double>(kMemories - 1);
      grid.push_back(noise_with(step_s, step_s * std::pow(longest_s / step_s, share), log_ratio));
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
  const double log_ratio = std::log(noise.correlated / noise.white * -std::expm1(-2.0 * step_s / noise.time_s));
  for (const double factor : {1.0 / third, 1.0, third}) {
    for (const double more : {-kBetweenRatios, 0.0, kBetweenRatios}) {
      if (factor == 1.0 && more == 0.0) continue;
      about.push_back(noise_with(step_s, noise.time_s * factor, log_ratio + more));
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

// x = (s, m, m'): the memory, an Ornstein-Uhlenbeck process; the discrepancy, Matern 3/2, with its slope. H = (1, 1,
// 0).
CovarianceFilter::CovarianceFilter(const Covariance& covariance, std::span<const double> time_s,
                                   std::span<const double> relative_variance, std::span<const double> shock)
    : has_slow_(covariance.slow > 0.0), has_memory_(covariance.correlated > 0.0) {
  using Matrix = Eigen::Matrix3d;
  const double lambda = has_slow_ ? std::sqrt(3.0) / covariance.slow_time_s : 1.0;
  const Eigen::Vector3d stationary(covariance.correlated, covariance.slow, lambda * lambda * covariance.slow);
  Matrix p = stationary.asDiagonal(), before = p, transition = Matrix::Zero(), added = p;
  double last_step = -1.0, last_variance = -1.0, last_factor = -1.0;
  bool settled = false;
  rows_.resize(time_s.size());
  for (std::size_t i = 0; i < time_s.size(); ++i) {
    const double variance =
        std::max(1e-12, covariance.white * (relative_variance.empty() ? 1.0 : relative_variance[i]));
    const bool starts = i == 0 || time_s[i] < time_s[i - 1];
    const double step = starts ? -1.0 : time_s[i] - time_s[i - 1];
    const bool same_step = !starts && std::abs(step - last_step) <= 1e-9 * step;
    const double factor = shock.empty() || starts ? 1.0 : shock[i];
    if (same_step && settled && variance == last_variance && factor == last_factor) {
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
    Matrix now = transition * p * transition.transpose() + added;
    now(0, 0) += (factor - 1.0) * added(0, 0);
    const Eigen::Vector3d ph = now.col(0) + now.col(1);
    const double s = ph[0] + ph[1] + variance;
    const Eigen::Vector3d gain = ph / s;
    p = now - gain * ph.transpose();
    settled = same_step && variance == last_variance && factor == last_factor &&
              (now - before).cwiseAbs().maxCoeff() <= 1e-12;
    before = now;
    last_step = step;
    last_variance = variance;
    last_factor = factor;
    rows_[i] = {transition(0, 0), transition(1, 1), transition(1, 2), transition(2, 1),  transition(2, 2),
                gain[0],          gain[1],          gain[2],          1.0 / std::sqrt(s)};
    log_determinant_ += std::log(s);
  }
}

void CovarianceFilter::apply(std::size_t first, RowMajorBlock block, RowMajorMatrix& state) const {
  if (block.cols() == 0) return;
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
      filter_row(row.decay, row.k0, row.scale, values, s);
    } else {
      values *= row.scale;
    }
  }
}

// The filter is e = y - H F x, x' = F x + K e, w = e scale; this is its adjoint, backwards.
void CovarianceFilter::apply_transposed(RowMajorMatrix& white) const {
  const Eigen::Index columns = white.cols();
  Eigen::ArrayXXd adjoint = Eigen::ArrayXXd::Zero(3, columns);
  for (Eigen::Index i = white.rows() - 1; i >= 0; --i) {
    const Row& row = rows_[static_cast<std::size_t>(i)];
    for (Eigen::Index k = 0; k < columns; ++k) {
      double& s = adjoint(0, k);
      double& m = adjoint(1, k);
      double& slope = adjoint(2, k);
      const double e = white(i, k) * row.scale + row.k0 * s + row.k1 * m + row.k2 * slope;
      const double level = m - e;
      s = row.decay * (s - e);
      m = row.f00 * level + row.f10 * slope;
      slope = row.f01 * level + row.f11 * slope;
      white(i, k) = e;
    }
  }
}

// Of z = (state, 1) before a row the squares from there on are z' M z, M by a recursion backwards; a column that begins
// there has no state.
Eigen::VectorXd CovarianceFilter::squares_of_steps() const {
  using Matrix = Eigen::Matrix4d;
  Eigen::VectorXd squares(static_cast<Eigen::Index>(rows_.size()));
  Matrix m = Matrix::Zero();
  for (Eigen::Index i = squares.size() - 1; i >= 0; --i) {
    const Row& row = rows_[static_cast<std::size_t>(i)];
    const Eigen::RowVector4d innovation(-row.decay, -row.f00, -row.f01, 1.0);
    Matrix next = Matrix::Zero();
    next(0, 0) = row.decay;
    next(1, 1) = row.f00;
    next(1, 2) = row.f01;
    next(2, 1) = row.f10;
    next(2, 2) = row.f11;
    next(3, 3) = 1.0;
    next += Eigen::Vector4d(row.k0, row.k1, row.k2, 0.0) * innovation;
    m = row.scale * row.scale * innovation.transpose() * innovation + next.transpose() * m * next;
    squares[i] = m(3, 3);
  }
  return squares;
}

}  // namespace ballbar
