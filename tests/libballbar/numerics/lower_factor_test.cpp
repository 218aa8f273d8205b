#include "ballbar/numerics/lower_factor.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace ballbar {
namespace {

Eigen::MatrixXd waves(Eigen::Index n) {
  Eigen::MatrixXd lower(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) lower(i, j) = std::sin(1.0 + 3.7 * static_cast<double>(i * n + j));
  }
  return lower;
}

// L = (1 0; 2 3), x = (4, 5): L'x = (4 + 10, 15), 196 + 225. What is above the diagonal is not read.
TEST(LowerFactor, of_two_by_hand) {
  Eigen::MatrixXd lower(2, 2);
  lower << 1, 1e9, 2, 3;
  const double x[] = {4.0, 5.0};
  double room[2];
  EXPECT_EQ(LowerFactor(lower).squared_norm(x, room), 421.0);
}

// To 1e-12 what Eigen makes of it, whose sums run otherwise.
TEST(LowerFactor, eight_at_once_are_each_alone_to_the_last_bit) {
  for (Eigen::Index n = 1; n < 40; ++n) {
    const auto count = static_cast<std::size_t>(n);
    const Eigen::MatrixXd lower = waves(n);
    const LowerFactor factor(lower);
    std::vector<LowerFactor::Eight> x(count);
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t k = 0; k < x[i].size(); ++k) x[i][k] = std::cos(2.3 * static_cast<double>(i * 8 + k));
    }
    const LowerFactor::Eight at_once = factor.squared_norms(x.data());
    for (std::size_t k = 0; k < at_once.size(); ++k) {
      Eigen::VectorXd one(n), room(n);
      for (std::size_t i = 0; i < count; ++i) one[static_cast<Eigen::Index>(i)] = x[i][k];
      EXPECT_EQ(factor.squared_norm(one.data(), room.data()), at_once[k]) << n << " by " << n << ", the " << k << "-th";
      const double by_eigen = (lower.triangularView<Eigen::Lower>().transpose() * one).squaredNorm();
      EXPECT_NEAR(at_once[k], by_eigen, 1e-12 * by_eigen);
    }
  }
}

}  // namespace
}  // namespace ballbar
