#include "ballbar/formats/recordings/ballbar_log.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <limits>

#include "bad_text.hpp"
#include "ballbar/units.hpp"

namespace ballbar {
namespace {

TEST(log, circle) {
  const Recording log = read_ballbar_log(good_text("log"), "file");
  EXPECT_EQ(log.kind, Kind::circle);
  EXPECT_EQ(log.motion, Motion::linear_axes);
  EXPECT_EQ(log.plane, Plane::XY);
  EXPECT_EQ(log.moving_ball, MovingBall::spindle);
  EXPECT_EQ(log.direction, Direction::CCW);
  EXPECT_EQ(log.nominal_length_mm, 100.0);
  EXPECT_EQ(log.elapsed_s, 60.0);
  EXPECT_EQ(log.started_s, std::nullopt);
  EXPECT_EQ(log.feed_mm_per_min, std::nullopt);
  EXPECT_EQ(log.height_offset_mm, 0.0);
  EXPECT_EQ(log.time_s, (std::vector<double>{0.0, 0.1, 0.2}));
  EXPECT_EQ(log.angle_rad, (std::vector<double>{rad_from_deg(45.0), rad_from_deg(135.0), rad_from_deg(225.0)}));
  EXPECT_EQ(log.length_mm, (std::vector<double>{100.001, 100.002, 100.003}));
}

TEST(log, axial) {
  const Recording log = read_ballbar_log(good_text("axial"), "file");
  EXPECT_EQ(log.kind, Kind::axial);
  EXPECT_TRUE(log.angle_rad.empty());
  EXPECT_EQ(log.length_mm, (std::vector<double>{100.001, 100.002}));
}

TEST(log, deviation_is_added_to_the_nominal_length) {
  const Recording log =
      read_ballbar_log(changed("log", "length_mm\n0.0,45.0,100.001\n0.1,135.0,100.002\n0.2,225.0,100.003",
                               "deviation_um\n0.0,45.0,-1.5\n0.1,135.0,0\n0.2,225.0,+2.5"),
                       "file");
  EXPECT_EQ(log.length_mm, (std::vector<double>{100.0 - 0.0015, 100.0, 100.0 + 0.0025}));
}

TEST(log, columns_are_known_by_name_and_blanks_are_nothing) {
  const Recording log = read_ballbar_log(
      changed("log", "time_s,angle_deg,length_mm\n0.0,45.0,100.001\n0.1,135.0,100.002\n0.2,225.0,100.003\n",
              "length_mm , angle_deg\n 99.5 ,\t-90\n+1.0e2, 0 \n\n\n"),
      "file");
  EXPECT_TRUE(log.time_s.empty());
  EXPECT_EQ(log.angle_rad, (std::vector<double>{rad_from_deg(-90.0), 0.0}));
  EXPECT_EQ(log.length_mm, (std::vector<double>{99.5, 100.0}));
}

TEST(log, direction_is_checked_across_the_wrap) {
  // 350, 10, 30: rises through 360.
  EXPECT_NO_THROW(read_ballbar_log(changed("log", "45.0", "350"), "file"));
}

TEST(log, started_is_local_time) {
  const Recording log = read_ballbar_log(changed("log", "elapsed_s = 60", "started = 1970-01-02T00:00:01"), "file");
  EXPECT_EQ(log.started_s, 86401);
}

TEST(log, optional_numbers) {
  const Recording log =
      read_ballbar_log(changed("log", "elapsed_s = 60",
                               "feed_mm_per_min = 1000\n# height_offset_mm = -5.5\n# bar_temperature_degC = 20.25"),
                       "file");
  EXPECT_EQ(log.feed_mm_per_min, 1000.0);
  EXPECT_EQ(log.height_offset_mm, -5.5);
  EXPECT_EQ(log.bar_temperature_degC, 20.25);
  EXPECT_EQ(log.elapsed_s, std::nullopt);
}

double finite(double low, double high) {
  return low + (high - low) * static_cast<double>(*rc::gen::arbitrary<std::uint32_t>()) / 4294967296.0;
}

TEST(log, written_and_read_again_is_the_same) {
  const bool passed = rc::check([] {
    Recording log;
    log.kind = *rc::gen::element(Kind::circle, Kind::axial);
    log.nominal_length_mm = finite(50.0, 600.0);
    if (*rc::gen::arbitrary<bool>()) log.elapsed_s = finite(-1e3, 1e9);
    if (*rc::gen::arbitrary<bool>()) log.started_s = *rc::gen::inRange<std::int64_t>(-1000000000, 4000000000);
    if (*rc::gen::arbitrary<bool>()) log.feed_mm_per_min = finite(1e-3, 1e6);
    if (*rc::gen::arbitrary<bool>()) log.bar_temperature_degC = finite(-40.0, 60.0);
    if (*rc::gen::arbitrary<bool>()) log.height_offset_mm = finite(-50.0, 50.0);
    const auto n = *rc::gen::inRange(4, 300);  // of fewer a step can be more than half a turn, which has no direction
    const bool circle = log.kind == Kind::circle;
    const bool timed = !circle || *rc::gen::arbitrary<bool>();
    if (circle) {
      log.motion = *rc::gen::element(Motion::linear_axes, Motion::rotary_axis, Motion::spindle);
      log.plane = *rc::gen::element(Plane::XY, Plane::YZ, Plane::ZX);
      log.moving_ball = *rc::gen::element(MovingBall::spindle, MovingBall::table);
      log.direction = *rc::gen::element(Direction::CCW, Direction::CW);
    }
    const double sign = log.direction == Direction::CCW ? 1.0 : -1.0;
    for (int i = 0; i < n; ++i) {
      if (timed) log.time_s.push_back((i + finite(0.0, 0.5)) * 0.01);
      if (circle) log.angle_rad.push_back(sign * (i + finite(0.0, 0.5)) * 2.0 * kPi / n);
      log.length_mm.push_back(log.nominal_length_mm + finite(-1.0, 1.0));
    }
    const Recording again = read_ballbar_log(write_ballbar_log(log), "file");
    RC_ASSERT(again.kind == log.kind);
    RC_ASSERT(again.motion == log.motion);
    RC_ASSERT(again.plane == log.plane);
    RC_ASSERT(again.moving_ball == log.moving_ball);
    RC_ASSERT(again.direction == log.direction);
    RC_ASSERT(again.nominal_length_mm == log.nominal_length_mm);
    RC_ASSERT(again.elapsed_s == log.elapsed_s);
    RC_ASSERT(again.started_s == log.started_s);
    RC_ASSERT(again.feed_mm_per_min == log.feed_mm_per_min);
    RC_ASSERT(again.bar_temperature_degC == log.bar_temperature_degC);
    RC_ASSERT(again.height_offset_mm == log.height_offset_mm);
    RC_ASSERT(again.time_s == log.time_s);
    RC_ASSERT(again.length_mm == log.length_mm);
    RC_ASSERT(again.angle_rad.size() == log.angle_rad.size());
    // To degrees and back is four roundings.
    for (std::size_t i = 0; i < log.angle_rad.size(); ++i) {
      RC_ASSERT(std::abs(again.angle_rad[i] - log.angle_rad[i]) <=
                2.0 * std::numeric_limits<double>::epsilon() * std::abs(log.angle_rad[i]));
    }
  });
  EXPECT_TRUE(passed);
}

}  // namespace
}  // namespace ballbar
