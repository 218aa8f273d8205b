#include <gtest/gtest.h>

#include "ballbar/error.hpp"
#include "ballbar/model/model.hpp"

namespace ballbar {
namespace {

TEST(target_columns, are_columns_of_the_data_in_any_unit) {
  const Series data{
      {0, 1},
      {{"z_um", Role::measured, {0, 1}}, {"y_um", Role::measured, {0, 1}}, {"tilt_urad", Role::measured, {0, 1}}}};
  const auto complaint = [&](const std::vector<std::string>& targets) {
    try {
      expect_explainable(targets, data);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(complaint({"z_um", "y_um"}), "");
  EXPECT_EQ(complaint({"z_um", "tilt_urad"}), "");
  EXPECT_EQ(complaint({"z_um", "z_um"}), "target: expected each column once, found \"z_um\" again.");
  EXPECT_EQ(complaint({}), "target: expected at least one column to explain, found none.");
  EXPECT_NE(complaint({"x_um"}).find("; the nearest is "), std::string::npos) << complaint({"x_um"});
}

}  // namespace
}  // namespace ballbar
