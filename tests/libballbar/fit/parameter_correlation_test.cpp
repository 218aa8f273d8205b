#include "ballbar/internal/fit/parameter_correlation.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace ballbar {
namespace {

// Variances 4, 9, 1 and of a held one 0: 3 / 6 = 0.5, -1.6 / 2 = -0.8.
Fit four() {
  Fit fit;
  fit.parameters.resize(4);
  fit.covariance.resize(4, 4);
  fit.covariance << 4, 3, -1.6, 0,  //
      3, 9, 0, 0,                   //
      -1.6, 0, 1, 0,                //
      0, 0, 0, 0;
  return fit;
}

TEST(parameter_correlation, by_hand) {
  const Eigen::MatrixXd correlation = correlation_of(four());
  EXPECT_DOUBLE_EQ(correlation(0, 0), 1.0);
  EXPECT_DOUBLE_EQ(correlation(0, 1), 0.5);
  EXPECT_DOUBLE_EQ(correlation(2, 0), -0.8);
  EXPECT_DOUBLE_EQ(correlation(1, 2), 0.0);
  EXPECT_TRUE(std::isnan(correlation(3, 3)));
  EXPECT_TRUE(std::isnan(correlation(0, 3)));
}

TEST(parameter_correlation, strongest_is_by_size) {
  const auto strongest = strongest_correlation(four(), 0);
  ASSERT_TRUE(strongest);
  EXPECT_EQ(strongest->with, 2u);
  EXPECT_DOUBLE_EQ(strongest->value, -0.8);
  EXPECT_EQ(strongest_correlation(four(), 1)->with, 0u);
  EXPECT_FALSE(strongest_correlation(four(), 3)) << "held";
}

}  // namespace
}  // namespace ballbar
