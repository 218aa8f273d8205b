#include "hal/hal_names.hpp"

#include <gtest/gtest.h>

#include "ballbar/error.hpp"

namespace ballbar::hal {
namespace {

using Names = std::vector<std::string>;

std::string fault(const Names& columns) {
  try {
    signal_pins("ballbar", columns);
  } catch (const Error& error) {
    return error.what();
  }
  return "none";
}

TEST(HalPinName, ColumnsAsHalWritesThem) {
  EXPECT_EQ(signal_pins("ballbar", Names{"T_xi_degC", "speed_rpm"}),
            (Names{"ballbar.signal.T-xi-degC", "ballbar.signal.speed-rpm"}));
  const std::string longest(32, 'T');  // "ballbar.signal." has 15 characters, 47 are taken
  EXPECT_EQ(signal_pins("ballbar", Names{longest}), Names{"ballbar.signal." + longest});
}

TEST(HalPinName, Faults) {
  EXPECT_EQ(fault({"T 1_degC"}),
            "column 'T 1_degC': expected letters, digits, '_', '-' and '.', of which a HAL name is made.");
  EXPECT_EQ(fault({"T_1_degC", "T-1_degC"}),
            "columns 'T_1_degC' and 'T-1_degC': both would be the pin 'ballbar.signal.T-1-degC'.");
  EXPECT_EQ(fault({"T_housing_behind_the_front_bearing_degC"}),
            "column 'T_housing_behind_the_front_bearing_degC': its pin "
            "'ballbar.signal.T-housing-behind-the-front-bearing-degC' has 54 characters, HAL takes 47.");
}

}  // namespace
}  // namespace ballbar::hal
