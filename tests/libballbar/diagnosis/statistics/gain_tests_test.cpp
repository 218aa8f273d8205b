// Gains that are the same in every cycle, and the error where a model was not fitted.
#include "diagnosis/statistics/gain_tests.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "diagnosis/by_hand.hpp"
#include "diagnosis/statistics/cross_validation.hpp"

namespace ballbar {
namespace {

// Mean of the other cycle predicts: errors 2 everywhere.
TEST(CrossValidation, held_out_is_predicted_from_the_rest) {
  const LinearisedFit linearised = by_hand::fit_with({1, 1, 1, -1, -1, -1});
  const CrossValidation found = cross_validation(linearised, {0.5, 0.0, 0.0, 0.0}, {0, 0, 0, 1, 1, 1}, false);
  EXPECT_NEAR(found.rmse_um, 2.0, 1e-9);
  EXPECT_NEAR(found.chi2, 6.0 * 4.0 / 0.25, 1e-6);
}

// 2 and 4 um about 0: each recording's own constant is no prediction of the other's.
TEST(CrossValidation, fits_what_belongs_to_the_recording_left_out_to_it) {
  LinearisedFit linearised;
  linearised.time_s = {0, 1, 2, 3};
  linearised.residual_um = Eigen::Vector4d(2.0, 4.0, 7.0, 5.0);
  linearised.model = Eigen::MatrixXd::Zero(4, 2);
  linearised.model.topLeftCorner(2, 1).setOnes();
  linearised.model.bottomRightCorner(2, 1).setOnes();
  EXPECT_NEAR(cross_validation(linearised, {1.0, 0.0, 0.0, 0.0}, {0, 0, 1, 1}, true).rmse_um, 1.0, 1e-12);
}

// Gain +1 in one cycle and -1 in the other, sigma 1: chi^2 = 2 sum of squares about the common gain 0 = 2 * 0.5 * 20.
TEST(GainTests, another_gain_in_every_cycle_is_seen) {
  std::vector<double> residual, same;
  Eigen::MatrixXd column(40, 1);
  for (int i = 0; i < 40; ++i) {
    column(i, 0) = i % 2 == 0 ? 1.0 : -1.0;
    residual.push_back((i < 20 ? 1.0 : -1.0) * column(i, 0));
    same.push_back(column(i, 0));
  }
  std::vector<std::size_t> fold(40, 0);
  for (std::size_t i = 20; i < 40; ++i) fold[i] = 1;
  const Noise noise{1.0, 0.0, 0.0, 0.0};
  EXPECT_NEAR(p_same_gain(by_hand::fit_with(residual), column, noise, fold), std::erfc(std::sqrt(40.0 / 2.0)), 1e-11);
  EXPECT_NEAR(p_same_gain(by_hand::fit_with(same), column, noise, fold), 1.0, 1e-9);
}

}  // namespace
}  // namespace ballbar
