#include "ballbar/circle/recording.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <string>
#include <utility>

#include "ballbar/series/series.hpp"
#include "ballbar/units.hpp"

namespace ballbar {
namespace {

// n readings at mid-sample of an arc.
Recording mid_sample(double start_deg, double arc_deg, int n) {
  Recording recording;
  for (int i = 0; i < n; ++i) recording.angle_rad.push_back(rad_from_deg(start_deg + (i + 0.5) * arc_deg / n));
  return recording;
}

// Adding up angles of up to 450 deg and wrapping them costs a few units in the last place.
constexpr double kRounding_deg = 1e-11;

TEST(arc, of_readings_at_mid_sample_is_the_arc) {
  for (const double arc_deg : {5.0, 100.0, 220.0, 300.0, 354.0}) {
    for (const double start_deg : {-20.0, 0.0, 90.0, 250.0, 355.0}) {
      EXPECT_NEAR(deg_from_rad(arc_rad(mid_sample(start_deg, arc_deg, 200))), arc_deg, kRounding_deg) << start_deg;
    }
  }
}

TEST(arc, is_a_full_turn_where_no_gap_is_wider_than_one_and_a_half_spacings) {
  EXPECT_EQ(arc_rad(mid_sample(90.0, 360.0, 1500)), 2.0 * kPi);
  EXPECT_EQ(arc_rad(mid_sample(0.0, 360.0, 2)), 2.0 * kPi);
  // 100 readings over 358 deg: gap 2 + 3.58 = 5.58 > 1.5 * 3.6 = 5.4; over 358.5 deg: 5.085.
  EXPECT_NEAR(deg_from_rad(arc_rad(mid_sample(0.0, 358.0, 100))), 358.0, kRounding_deg);
  EXPECT_EQ(arc_rad(mid_sample(0.0, 358.5, 100)), 2.0 * kPi);
}

TEST(arc, does_not_depend_on_the_order_of_readings) {
  Recording recording = mid_sample(300.0, 220.0, 500);
  const double in_order = arc_rad(recording);
  std::mt19937 random(1);
  std::shuffle(recording.angle_rad.begin(), recording.angle_rad.end(), random);
  EXPECT_EQ(arc_rad(recording), in_order);
}

TEST(arc, of_few_readings) {
  EXPECT_EQ(arc_rad(mid_sample(0.0, 100.0, 0)), 0.0);
  EXPECT_EQ(arc_rad(mid_sample(0.0, 100.0, 1)), 0.0);
  Recording same;
  same.angle_rad = {1.0, 1.0, 1.0};
  EXPECT_EQ(arc_rad(same), 0.0);
  // 0 and 60 deg: one share of 60 between them, one added back.
  Recording sixth;
  sixth.angle_rad = {0.0, kPi / 3.0};
  EXPECT_NEAR(arc_rad(sixth), 2.0 * kPi / 3.0, 1e-15);
}

TEST(plane, axes_exchanged_are_those_of_the_other_hand) {
  for (const auto& [plane, exchanged] :
       {std::pair(Plane::XY, Plane::YX), std::pair(Plane::YZ, Plane::ZY), std::pair(Plane::ZX, Plane::XZ)}) {
    const auto [a, b] = axes_of(plane);
    EXPECT_EQ(axes_of(exchanged), (std::array{b, a}));
    EXPECT_EQ(name_of(exchanged), std::string({"XYZ"[b], "XYZ"[a]}));
  }
}

TEST(plane, axes_are_right_handed) {
  for (const Plane plane : {Plane::XY, Plane::YZ, Plane::ZX}) {
    const auto [a, b] = axes_of(plane);
    EXPECT_EQ((a + 1) % 3, b);
    EXPECT_EQ(name_of(plane), std::string({"XYZ"[a], "XYZ"[b]}));
  }
}

TEST(names, are_those_of_the_log_format) {
  EXPECT_EQ(name_of(Kind::circle), "circle");
  EXPECT_EQ(name_of(Kind::axial), "axial");
  EXPECT_EQ(name_of(Motion::linear_axes), "linear_axes");
  EXPECT_EQ(name_of(Motion::rotary_axis), "rotary_axis");
  EXPECT_EQ(name_of(Motion::spindle), "spindle");
  EXPECT_EQ(name_of(MovingBall::spindle), "spindle");
  EXPECT_EQ(name_of(MovingBall::table), "table");
  EXPECT_EQ(name_of(Direction::CCW), "CCW");
  EXPECT_EQ(name_of(Direction::CW), "CW");
}

TEST(column, unit_is_the_end_of_its_name) {
  EXPECT_EQ(unit_of("T_air_degC"), "degC");
  EXPECT_EQ(unit_of("x_sigma_um"), "um");
  EXPECT_EQ(unit_of("speed_rpm"), "rpm");
  EXPECT_EQ(unit_of("T_F"), "");
  EXPECT_EQ(unit_of("um"), "");
  EXPECT_EQ(unit_of("_um"), "");
  EXPECT_EQ(unit_of(""), "");
}

TEST(column, role_follows_from_the_unit) {
  EXPECT_EQ(role_from_unit("rpm"), Role::speed);
  EXPECT_EQ(role_from_unit("degC"), Role::structure);
  EXPECT_EQ(role_from_unit("um"), Role::measured);
  EXPECT_EQ(role_from_unit("mm"), Role::measured);
  EXPECT_EQ(role_from_unit("A"), Role::load);
  EXPECT_EQ(role_from_unit("W"), Role::load);
  EXPECT_EQ(role_from_unit("K"), Role::event);
  EXPECT_EQ(role_from_unit(""), Role::event);
}

TEST(column, role_names_read_back) {
  for (int i = 0; i <= static_cast<int>(Role::measured); ++i) {
    EXPECT_EQ(role_from_name(name_of(static_cast<Role>(i))), static_cast<Role>(i));
  }
  EXPECT_EQ(role_from_name("oil"), std::nullopt);
}

TEST(column, is_found_by_name) {
  const Series series{.time_s = {0.0}, .columns = {{"x_um", Role::measured, {1.0}}, {"y_um", Role::measured, {2.0}}}};
  EXPECT_EQ(find_column(series, "y_um"), &series.columns[1]);
  EXPECT_EQ(find_column(series, "z_um"), nullptr);
}

}  // namespace
}  // namespace ballbar
