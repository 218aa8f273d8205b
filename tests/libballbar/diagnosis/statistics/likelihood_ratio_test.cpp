// Likelihoods against dense matrices.
#include "diagnosis/statistics/likelihood_ratio.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>
#include <random>

#include "diagnosis/by_hand.hpp"
#include "diagnosis/statistics/gaussian_process_alternative.hpp"

namespace ballbar {
namespace {

// Generalised least squares and its likelihood against dense matrices.
TEST(LikelihoodRatio, gls_fit_is_generalised_least_squares) {
  const std::vector<double> residual{0.3, -0.2, 0.5, 0.9, 1.4, 1.1, 1.9, 2.3};
  const LinearisedFit linearised = by_hand::fit_with(residual);
  const Noise noise{0.2, 0.4, 120.0, 0.0};
  Eigen::MatrixXd added(8, 1);
  added << 0, 1, 2, 3, 4, 5, 6, 7;
  const GlsFit found = gls_fit(linearised, added, noise, 0);
  Eigen::MatrixXd covariance(8, 8), x(8, 2);
  for (int i = 0; i < 8; ++i) {
    for (int j = 0; j < 8; ++j) {
      covariance(i, j) = 0.16 * std::exp(-60.0 * std::abs(i - j) / 120.0) + (i == j ? 0.04 : 0.0);
    }
  }
  x << linearised.model, added;
  const Eigen::MatrixXd inverse = covariance.inverse();
  const Eigen::VectorXd gains =
      (x.transpose() * inverse * x).ldlt().solve(x.transpose() * inverse * linearised.residual_um);
  EXPECT_NEAR(found.gains[0], gains[1], 1e-10);
  const Eigen::VectorXd left = linearised.residual_um - x * gains;
  const double dense =
      -0.5 * (8.0 * std::log(2.0 * M_PI) + std::log(covariance.determinant()) + left.dot(inverse * left));
  EXPECT_NEAR(found.log_likelihood, dense, 1e-9);
}

TEST(GaussianProcessAlternative, likelihood_is_that_of_the_dense_covariance) {
  const std::vector<double> residual{0.3, -0.2, 0.5, 0.9, 1.4, 1.1};
  LinearisedFit linearised = by_hand::fit_with(residual);
  linearised.time_s = {0.0, 60.0, 90.0, 200.0, 260.0, 400.0};
  const Noise noise{0.2, 0.4, 120.0, 0.0};
  const double amplitude = 0.7, length_s = 150.0;
  Eigen::MatrixXd covariance(6, 6);
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) {
      const double dt =
          std::abs(linearised.time_s[static_cast<std::size_t>(i)] - linearised.time_s[static_cast<std::size_t>(j)]);
      const double s = std::sqrt(3.0) * dt / length_s;
      covariance(i, j) =
          0.16 * std::exp(-dt / 120.0) + amplitude * amplitude * (1.0 + s) * std::exp(-s) + (i == j ? 0.04 : 0.0);
    }
  }
  const Eigen::MatrixXd inverse = covariance.inverse();
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(6);
  const double mean = ones.dot(inverse * linearised.residual_um) / ones.dot(inverse * ones);
  const Eigen::VectorXd left = linearised.residual_um - mean * ones;
  const double dense =
      -0.5 * (6.0 * std::log(2.0 * M_PI) + std::log(covariance.determinant()) + left.dot(inverse * left));
  EXPECT_NEAR(log_likelihood(linearised, noise, amplitude, length_s), dense, 1e-9);
}

// Even steps until the gains are steady, then a gap.
TEST(GaussianProcessAlternative, a_gap_after_steady_steps_is_that_of_the_dense_covariance) {
  const Eigen::Index n = 160;
  LinearisedFit linearised;
  linearised.residual_um.resize(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    linearised.time_s.push_back(60.0 * static_cast<double>(i) + (i >= 120 ? 500.0 : 0.0));
    linearised.residual_um[i] = std::sin(0.05 * static_cast<double>(i)) + 0.2 * std::cos(1.7 * static_cast<double>(i));
  }
  linearised.model = Eigen::MatrixXd(n, 0);
  const Noise noise{0.2, 0.3, 100.0, 0.0};
  Eigen::MatrixXd covariance(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      const double dt =
          std::abs(linearised.time_s[static_cast<std::size_t>(i)] - linearised.time_s[static_cast<std::size_t>(j)]);
      const double s = std::sqrt(3.0) * dt / 400.0;
      covariance(i, j) = 0.09 * std::exp(-dt / 100.0) + 0.49 * (1.0 + s) * std::exp(-s) + (i == j ? 0.04 : 0.0);
    }
  }
  const Eigen::LLT<Eigen::MatrixXd> factor(covariance);
  const double log_det = 2.0 * Eigen::MatrixXd(factor.matrixL()).diagonal().array().log().sum();
  const double dense = -0.5 * (static_cast<double>(n) * std::log(2.0 * M_PI) + log_det +
                               linearised.residual_um.dot(factor.solve(linearised.residual_um)));
  EXPECT_NEAR(log_likelihood(linearised, noise, 0.7, 400.0), dense, 1e-6);
}

}  // namespace
}  // namespace ballbar
