// A long series with fewer values of its target.
#include "series/subsampled.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "diagnosis/by_hand.hpp"

namespace ballbar {
namespace {

TEST(Subsampled, keeps_every_kth_value_of_the_target_and_all_inputs) {
  Series data = by_hand::rows_of(6, 10.0);
  data.columns = {{"z_um", Role::measured, {1, 3, std::nan(""), 5, 7, 9}},
                  {"T_degC", Role::structure, {1, 2, 3, 4, 5, 6}}};
  const Series found = subsampled(data, "z_um", 3);
  EXPECT_EQ(found.time_s, data.time_s);
  EXPECT_EQ(found.columns[1].values, data.columns[1].values);
  const std::vector<double>& left = found.columns[0].values;
  EXPECT_EQ(left[0], 1.0);
  EXPECT_TRUE(std::isnan(left[1]));
  EXPECT_TRUE(std::isnan(left[2]));
  EXPECT_EQ(left[3], 5.0);
  EXPECT_TRUE(std::isnan(left[4]));
  EXPECT_EQ(left[5], 9.0);
  EXPECT_EQ(subsampled(data, "z_um", 5).columns[0].values[1], 3.0);
}

TEST(Subsampled, keeps_all_values_about_a_moment) {
  Series data = by_hand::rows_of(40, 10.0);
  data.columns = {{"z_um", Role::measured, std::vector<double>(40, 1.0)}};
  const std::vector<double> moments{200.0};
  const Series found = subsampled(data, "z_um", 20, moments);  // every second, and six to either side of 205 s
  std::vector<double> kept_s;
  for (std::size_t row = 0; row < 40; ++row) {
    if (!std::isnan(found.columns[0].values[row]) && row % 2 == 1) kept_s.push_back(found.time_s[row]);
  }
  EXPECT_EQ(kept_s, (std::vector<double>{150.0, 170.0, 190.0, 210.0, 230.0, 250.0}));
}

// 30000 values to either side of the moment would be whole: 120 are kept.
TEST(Subsampled, keeps_no_more_about_a_moment_of_a_very_long_series) {
  Series data = by_hand::rows_of(100000, 1.0);
  data.columns = {{"z_um", Role::measured, std::vector<double>(100000, 1.0)}};
  const std::vector<double> moments{50000.0};
  const std::vector<double> kept = subsampled(data, "z_um", 10, moments).columns[0].values;
  const auto count = kept.size() - static_cast<std::size_t>(std::count_if(
                                       kept.begin(), kept.end(), [](double value) { return std::isnan(value); }));
  EXPECT_GT(count, 110U);
  EXPECT_LE(count, 130U);
}

}  // namespace
}  // namespace ballbar
