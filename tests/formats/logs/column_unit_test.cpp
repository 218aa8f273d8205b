#include "ballbar/formats/logs/column_unit.hpp"

#include <gtest/gtest.h>

namespace ballbar {
namespace {

TEST(column_unit, as_people_write_it) {
  for (const char* celsius : {"°C", "C", "degC"}) EXPECT_EQ(column_unit(celsius)->canonical, "degC") << celsius;
  const auto fahrenheit = column_unit("degF");
  ASSERT_TRUE(fahrenheit);
  EXPECT_EQ(fahrenheit->canonical, "degC");
  EXPECT_NEAR(fahrenheit->factor * 68.0 + fahrenheit->offset, 20.0, 1e-12);
  EXPECT_FALSE(column_unit("furlong"));
}

TEST(column_unit, at_the_end_of_a_name) {
  EXPECT_EQ(in_unit_of_series("T_room_degF")->name, "T_room_degC");
  EXPECT_EQ(in_unit_of_series("Speed (1/min)")->name, "Speed_rpm");
  EXPECT_FALSE(in_unit_of_series("T_room_degC"));
  EXPECT_FALSE(in_unit_of_series("x_mm"));
  EXPECT_FALSE(in_unit_of_series("power"));
}

TEST(column_unit, of_a_length_that_becomes_um) {
  const auto of_mm = in_um("z_mm"), of_m = in_um("z_m"), sigma = in_um("z_sigma_mm");
  ASSERT_TRUE(of_mm && of_m && sigma);
  EXPECT_EQ(of_mm->name, "z_um");
  EXPECT_EQ(of_mm->unit.factor, 1e3);
  EXPECT_EQ(of_m->name, "z_um");
  EXPECT_EQ(of_m->unit.factor, 1e6);
  EXPECT_EQ(sigma->name, "z_sigma_um");
  for (const char* other : {"z_um", "T_degC", "tilt_urad", "pos_steps", "delta_L"}) EXPECT_FALSE(in_um(other)) << other;
}

}  // namespace
}  // namespace ballbar
