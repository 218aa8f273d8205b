#include "numerics/tukey.hpp"

#include <gtest/gtest.h>

namespace ballbar {
namespace {

// u = 0, 1/2, 1, 2 at a sigma of 2.
const Eigen::ArrayXd kResidual = Eigen::Array4d(0.0, 0.5, -1.0, 2.0) * (2.0 * kTukey);

TEST(Tukey, weight_falls_to_nothing_at_4_685_sigma) {
  const Eigen::ArrayXd root = tukey(kResidual, 2.0);
  EXPECT_EQ(root[0], 1.0);
  EXPECT_NEAR(root[1], 0.75, 1e-15);
  EXPECT_NEAR(root[2], 0.0, 1e-15);
  EXPECT_EQ(root[3], 0.0);
  EXPECT_EQ(discounted_by(root), (std::vector<std::size_t>{2, 3}));
}

// psi = r (1 - u^2)^2 is 0, (k / 2) 9/16, 0, 0 with k = 2 * 4.685; psi' = (1 - u^2)(1 - 5 u^2) is 1, -3/16, 0, 0.
TEST(Tukey, variance_of_an_estimate_by_hand) {
  const double psi = kTukey * 9.0 / 16.0, slope = 13.0 / 16.0;
  EXPECT_NEAR(robust_variance(kResidual, 2.0, 1.0), 16.0 / 3.0 * psi * psi / (slope * slope), 1e-12);
  EXPECT_NEAR(robust_variance(kResidual, 2.0, 3.5), 16.0 * psi * psi / (slope * slope), 1e-12);  // n - p at least 1
}

TEST(Tukey, of_a_residual_without_scatter_is_whole_where_it_is_0) {
  const Eigen::ArrayXd root = tukey(Eigen::Array3d(0.0, 0.0, 1.0), 0.0);
  EXPECT_EQ(root[0], 1.0);
  EXPECT_EQ(root[2], 0.0);
}

}  // namespace
}  // namespace ballbar
