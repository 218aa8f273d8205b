#include "ballbar/internal/numerics/order_statistic.hpp"

#include <gtest/gtest.h>

#include "numerics/median.hpp"

namespace ballbar {
namespace {

TEST(OrderStatistic, has_so_many_before_it) {
  const std::vector<double> values{5.0, 1.0, 4.0, 1.0};
  EXPECT_EQ(order_statistic(values, 0), 1.0);
  EXPECT_EQ(order_statistic(values, 1), 1.0);
  EXPECT_EQ(order_statistic(values, 2), 4.0);
  EXPECT_EQ(order_statistic(values, 3), 5.0);
}

TEST(Median, of_an_even_number_is_the_upper_one) {
  EXPECT_EQ(median(std::vector<double>{3.0, 9.0, 1.0}), 3.0);
  EXPECT_EQ(median(std::vector<double>{3.0, 9.0, 1.0, 4.0}), 4.0);
  EXPECT_EQ(median_sigma(std::vector<double>{-3.0, 9.0, 1.0}), 1.4826 * 3.0);
}

// Where time stands still or goes back there is no step.
TEST(MedianStep, is_of_the_steps_forward) {
  EXPECT_EQ(median_step_s(std::vector<double>{0.0, 1.0, 1.0, 3.0, 0.0, 5.0}), 2.0);
  EXPECT_EQ(median_step_s(std::vector<double>{4.0}), 0.0);
  EXPECT_EQ(median_step_s(std::vector<double>{4.0, 4.0}), 0.0);
}

}  // namespace
}  // namespace ballbar
