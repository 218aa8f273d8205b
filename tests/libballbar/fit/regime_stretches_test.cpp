#include <gtest/gtest.h>

#include <cmath>

#include "ballbar/fit/fit.hpp"

namespace ballbar {
namespace {

// A row a minute: at rest for 30 min, then 3000 rpm for 2 h. 10 min after the change, until 60 min after it warming.
TEST(regime_stretches, follow_on_each_other) {
  Series data;
  Column speed{"speed_rpm", Role::speed, {}};
  for (int minute = 0; minute < 150; ++minute) {
    data.time_s.push_back(60.0 * minute);
    speed.values.push_back(minute < 30 ? 0.0 : 3000.0);
  }
  data.columns = {speed};
  const std::vector<RegimeStretch> found = regime_stretches(data);
  const RegimeStretch expected[] = {{Regime::standstill, 0.0, 1800.0},
                                    {Regime::after_change, 1800.0, 2400.0},
                                    {Regime::warming, 2400.0, 5400.0},
                                    {Regime::steady, 5400.0, 8940.0}};
  ASSERT_EQ(found.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(found[i].regime, expected[i].regime) << i;
    EXPECT_EQ(found[i].from_s, expected[i].from_s) << i;
    EXPECT_EQ(found[i].to_s, expected[i].to_s) << i;
  }
}

TEST(regime_stretches, none_without_a_speed) {
  Series data{{0, 1}, {{"T_degC", Role::structure, {20, 21}}}};
  EXPECT_TRUE(regime_stretches(data).empty());
  data.columns.push_back({"speed_rpm", Role::speed, {std::nan(""), std::nan("")}});
  EXPECT_TRUE(regime_stretches(data).empty());
}

}  // namespace
}  // namespace ballbar
