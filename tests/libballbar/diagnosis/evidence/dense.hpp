// The same evidence by the whole covariance matrix: every gain and every known column a term of it.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "noise/linear_filter.hpp"

namespace ballbar::dense {

// C of linear_filter.hpp, written out. A row whose time goes back begins anew: nothing before it goes with it.
inline Eigen::MatrixXd matrix_of(const Covariance& one, const std::vector<double>& time_s,
                                 const std::vector<double>& relative_variance = {}) {
  const std::size_t n = time_s.size();
  std::vector<std::size_t> part(n, 0);
  for (std::size_t i = 1; i < n; ++i) part[i] = part[i - 1] + (time_s[i] < time_s[i - 1] ? 1 : 0);
  Eigen::MatrixXd c(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(n));
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      double value = 0.0;
      if (part[i] == part[j]) {
        const double apart_s = std::abs(time_s[i] - time_s[j]);
        if (one.correlated > 0.0) value += one.correlated * std::exp(-apart_s / one.time_s);
        if (one.slow > 0.0) {
          const double s = (one.slow_is_rough ? 1.0 : std::sqrt(3.0)) * apart_s / one.slow_time_s;
          value += one.slow * (one.slow_is_rough ? 1.0 : 1.0 + s) * std::exp(-s);
        }
      }
      if (i == j) value += one.white * (relative_variance.empty() ? 1.0 : relative_variance[i]);
      c(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = value;
    }
  }
  return c;
}

inline double log_determinant(const Eigen::MatrixXd& positive) {
  const Eigen::MatrixXd lower = positive.llt().matrixL();
  return 2.0 * lower.diagonal().array().log().sum();
}

// y = X a + scatter of covariance s^2 C, a flat.
struct Flat {
  double half_log = 0.0;  // 1/2 ln |C| + 1/2 ln |X' C^-1 X|
  double square = 0.0;    // of what is left of y
};
inline Flat flat(const Eigen::VectorXd& y, const Eigen::MatrixXd& x, const Eigen::MatrixXd& c) {
  const Eigen::LLT<Eigen::MatrixXd> factor(c);
  Flat result{0.5 * log_determinant(c), y.dot(factor.solve(y))};
  if (x.cols() == 0) return result;
  const Eigen::MatrixXd cx = factor.solve(x), xx = x.transpose() * cx;
  const Eigen::VectorXd xy = cx.transpose() * y;
  result.half_log += 0.5 * log_determinant(xx);
  result.square -= xy.dot(xx.llt().solve(xy));
  return result;
}

// Products, over C, of what is left of these columns beside flat ones.
inline Eigen::MatrixXd left_of(const Eigen::MatrixXd& columns, const Eigen::MatrixXd& x, const Eigen::MatrixXd& c) {
  if (columns.cols() == 0) return Eigen::MatrixXd(0, 0);
  const Eigen::LLT<Eigen::MatrixXd> factor(c);
  const Eigen::MatrixXd cg = factor.solve(columns);
  Eigen::MatrixXd left = columns.transpose() * cg;
  if (x.cols() == 0) return left;
  const Eigen::MatrixXd xg = x.transpose() * cg;
  left -= xg.transpose() * (x.transpose() * factor.solve(x)).llt().solve(xg);
  return left;
}

inline double log_mean(const std::vector<double>& logarithms) {
  const double most = *std::max_element(logarithms.begin(), logarithms.end());
  double sum = 0.0;
  for (const double one : logarithms) sum += std::exp(one - most);
  return most + std::log(sum / static_cast<double>(logarithms.size()));
}

// ln of the integral over s of s^-nu exp(-S / 2 s^2) ds / s, by the trapezium rule over ln s: from it, at both ends,
// nothing is left. It is the Gamma function's, -nu/2 ln S and a constant.
inline double log_over_scale(double square, double nu) {
  const double peak = 0.5 * std::log(square / nu);
  std::vector<double> values;
  constexpr double kStep = 1e-3;
  for (double t = peak - 2.0; t < peak + 2.0; t += kStep) values.push_back(-nu * t - 0.5 * square * std::exp(-2.0 * t));
  return log_mean(values) + std::log(kStep * static_cast<double>(values.size()));
}

}  // namespace ballbar::dense
