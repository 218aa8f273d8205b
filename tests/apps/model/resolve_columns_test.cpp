#include "model/resolve_columns.hpp"

#include <gtest/gtest.h>

#include "ballbar/error.hpp"

namespace ballbar {
namespace {

Series data() {
  Series series;
  series.time_s = {0.0, 1.0};
  series.columns = {{"speed_rpm", Role::speed, {0.0, 1.0}},
                    {"T_air_degC", Role::ambient, {20.0, 21.0}},
                    {"T_oil_degC", Role::coolant, {20.0, 21.0}},
                    {"z_um", Role::measured, {0.0, 1.0}}};
  return series;
}

std::string bound(const std::string& text) {
  try {
    return label_of(resolve_columns(effect_text(text, Level::series), data(), "z_um"));
  } catch (const Error& error) {
    return error.what();
  }
}

TEST(ResolveColumns, ColumnsAreStatedOrTheOnlyChoice) {
  EXPECT_EQ(bound("lagged_expansion:temperature=T_air_degC"), "lagged_expansion(T_air_degC)");
  EXPECT_EQ(bound("speed_heating"), "speed_heating(speed_rpm)");
  EXPECT_EQ(bound("gradient_bending:cold=T_air_degC,hot=T_oil_degC"), "gradient_bending(T_oil_degC, T_air_degC)");
  EXPECT_EQ(bound("viscosity_feedback:temperature=T_oil_degC"), "viscosity_feedback(speed_rpm, T_oil_degC)");
  EXPECT_EQ(bound("linear_drift"), "linear_drift");
}

TEST(ResolveColumns, ColumnsThatDoNotSuitAreNamed) {
  const std::pair<std::string, std::string> table[] = {
      {"expansion:temperature=T_iar_degC",
       "expected a column of the data for temperature of expansion, found \"T_iar_degC\"; the nearest is T_air_degC."},
      {"expansion:temperature=speed_rpm",
       "expected a column in degC or K for temperature of expansion, found \"speed_rpm\"."},
      {"expansion",
       "expected a column for temperature of expansion, as in expansion:temperature=T_air_degC; the columns are "
       "T_air_degC, T_oil_degC."},
      {"load_heating", "expected a column in W or A or percent or Nm for load of load_heating, found none."},
      {"preload_loss:signal=z_um",
       "expected a column for signal of preload_loss that is not the target, found \"z_um\"."},
  };
  for (const auto& [text, message] : table) EXPECT_EQ(bound(text), message) << text;
}

}  // namespace
}  // namespace ballbar
