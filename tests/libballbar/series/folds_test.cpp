// Folds that are left out one by one.
#include "series/folds.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>

namespace ballbar {
namespace {

// 120 rows of a minute.
Series with_speed(const std::vector<std::pair<std::size_t, double>>& stretches) {
  Series data;
  Column speed{"speed_rpm", Role::speed, {}};
  for (const auto& [rows, rpm] : stretches) speed.values.insert(speed.values.end(), rows, rpm);
  for (std::size_t i = 0; i < speed.values.size(); ++i) data.time_s.push_back(60.0 * static_cast<double>(i));
  data.columns = {std::move(speed)};
  return data;
}

std::vector<std::size_t> cycles_of_all(const Series& data) {
  std::vector<std::size_t> rows(data.time_s.size());
  std::iota(rows.begin(), rows.end(), std::size_t{0});
  return folds_of(data, rows);
}

std::map<std::size_t, std::size_t> lengths(const std::vector<std::size_t>& fold) {
  std::map<std::size_t, std::size_t> count;
  for (const std::size_t one : fold) ++count[one];
  return count;
}

// One long run of 100 rows after 20 at rest: no cycle is longer than a fifth of the record.
TEST(Folds, a_long_stretch_is_cut_into_equal_pieces) {
  const std::vector<std::size_t> fold = cycles_of_all(with_speed({{20, 0.0}, {100, 5000.0}}));
  EXPECT_TRUE(std::is_sorted(fold.begin(), fold.end()));
  EXPECT_EQ(fold[19], 0U);
  EXPECT_EQ(fold[20], 1U);
  const auto length = lengths(fold);
  EXPECT_EQ(length.size(), 6U);
  for (const auto& [one, rows] : length) EXPECT_EQ(rows, 20U) << one;
}

TEST(Folds, a_speed_that_never_changes_leaves_five_parts) {
  const auto length = lengths(cycles_of_all(with_speed({{120, 3000.0}})));
  EXPECT_EQ(length.size(), 5U);
  for (const auto& [one, rows] : length) EXPECT_EQ(rows, 24U) << one;
}

}  // namespace
}  // namespace ballbar
