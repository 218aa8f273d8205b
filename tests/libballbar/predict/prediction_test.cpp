#include <gtest/gtest.h>

#include <cmath>

#include "ballbar/predict/predict.hpp"

namespace ballbar {
namespace {

// Errors 0.5 and 2 um of the two measured rows: (0.25 + 4) / 2; one within 1 um. From the second row on 2 um.
TEST(prediction, error_of_what_was_measured) {
  RegressionPrediction prediction;
  prediction.predicted_um = {1.0, 2.0, 3.0};
  prediction.half_width_um = {1.0, 1.0, 1.0};
  const double measured_um[] = {1.5, 4.0, std::nan("")};
  const auto error = error_of(prediction, measured_um);
  ASSERT_TRUE(error);
  EXPECT_EQ(error->rows, 2u);
  EXPECT_DOUBLE_EQ(error->mean_um, 1.25);
  EXPECT_DOUBLE_EQ(error->rmse_um, std::sqrt(2.125));
  EXPECT_DOUBLE_EQ(error->within_share, 0.5);
  EXPECT_DOUBLE_EQ(error_of(prediction, measured_um, 1)->mean_um, 2.0);
  const double nothing[] = {std::nan(""), std::nan(""), std::nan("")};
  EXPECT_FALSE(error_of(prediction, nothing));
}

// More than 2 rows and more than a 50th: of 200 rows 4 pass, 5 do not; of 10 rows 2 pass.
TEST(prediction, a_few_rows_beyond_training_are_chance) {
  const auto found = [](std::size_t rows, std::size_t far, std::size_t odd) {
    RegressionPrediction prediction;
    prediction.predicted_um.assign(rows, 0.0);
    prediction.T2_of_largest.assign(rows, 1.0);
    prediction.Q_of_largest.assign(rows, 0.5);
    for (std::size_t i = 0; i < far; ++i) prediction.T2_of_largest[i] = 1.1;
    for (std::size_t i = 0; i < odd; ++i) prediction.Q_of_largest[i] = 2.0;
    return extrapolation_of(prediction);
  };
  EXPECT_FALSE(found(200, 4, 4).matters);
  EXPECT_TRUE(found(200, 5, 0).matters);
  EXPECT_TRUE(found(200, 0, 5).matters);
  EXPECT_FALSE(found(10, 2, 2).matters);
  EXPECT_TRUE(found(10, 3, 0).matters);
  EXPECT_EQ(found(200, 5, 1).far, 5u);
  EXPECT_EQ(found(200, 5, 1).odd, 1u);
}

}  // namespace
}  // namespace ballbar
