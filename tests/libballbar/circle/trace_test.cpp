#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "ballbar/circle/recording.hpp"
#include "ballbar/effects/effect.hpp"
#include "ballbar/error.hpp"
#include "ballbar/units.hpp"

namespace ballbar {
namespace {

// Four readings at mid-sample of a full turn at 1200 pi mm/min on 100 mm: 200 pi mm / 20 pi mm/s = 10 s.
Recording quarters(Direction direction) {
  Recording recording;
  recording.direction = direction;
  recording.height_offset_mm = 2.0;
  recording.feed_mm_per_min = 1200.0 * kPi;
  recording.bar_temperature_degC = 21.5;
  for (const double angle_deg : {45.0, 135.0, 225.0, 315.0}) {
    recording.angle_rad.push_back(rad_from_deg(direction == Direction::CCW ? angle_deg : 360.0 - angle_deg));
  }
  recording.length_mm = {100.001, 100.002, 99.999, 100.0};
  return recording;
}

const std::vector<double>& column(const Series& trace, std::string_view name) {
  const Column* const found = find_column(trace, name);
  EXPECT_NE(found, nullptr) << name;
  static const std::vector<double> none;
  return found == nullptr ? none : found->values;
}

void expect_near(const std::vector<double>& values, const std::vector<double>& expected, double tolerance) {
  ASSERT_EQ(values.size(), expected.size());
  for (std::size_t i = 0; i < values.size(); ++i) EXPECT_NEAR(values[i], expected[i], tolerance) << i;
}

TEST(trace_of, puts_recordings_one_after_the_other) {
  const std::vector<Recording> recordings{quarters(Direction::CCW), quarters(Direction::CW)};
  const Series trace = trace_of(recordings);
  expect_near(trace.time_s, {0.0, 2.5, 5.0, 7.5, 8.5, 11.0, 13.5, 16.0}, 1e-9);
  expect_near(column(trace, "deviation_um"), {1.0, 2.0, -1.0, 0.0, 1.0, 2.0, -1.0, 0.0}, 1e-9);
  expect_near(column(trace, "sweep_s"), {-3.75, -1.25, 1.25, 3.75, -3.75, -1.25, 1.25, 3.75}, 1e-9);
  EXPECT_EQ(column(trace, "direction"), (std::vector{1.0, 1.0, 1.0, 1.0, -1.0, -1.0, -1.0, -1.0}));
  EXPECT_EQ(column(trace, "recording"), (std::vector{0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0}));
  EXPECT_NEAR(column(trace, "angle_rad")[4], rad_from_deg(315.0), 1e-12);
  EXPECT_EQ(column(trace, "radius_mm")[7], 100.0);
  EXPECT_EQ(column(trace, "height_mm")[7], 2.0);
  EXPECT_EQ(column(trace, "bar_degC")[7], 21.5);
  EXPECT_EQ(column(trace, "feed_mm_per_min")[7], 1200.0 * kPi);
}

TEST(trace_of, takes_the_recordings_own_times) {
  Recording recording = quarters(Direction::CCW);
  recording.time_s = {3.0, 4.0, 6.0, 9.0};
  const Series trace = trace_of(std::vector{recording, recording});
  EXPECT_EQ(trace.time_s, (std::vector{0.0, 1.0, 3.0, 6.0, 7.0, 8.0, 10.0, 13.0}));
  EXPECT_EQ(column(trace, "sweep_s"), (std::vector{-3.0, -2.0, 0.0, 3.0, -3.0, -2.0, 0.0, 3.0}));
}

TEST(trace_of, says_what_is_not_stated_and_takes_one_reading_a_second) {
  Recording recording = quarters(Direction::CCW);
  recording.feed_mm_per_min.reset();
  recording.bar_temperature_degC.reset();
  const Series trace = trace_of(std::vector{recording});
  EXPECT_TRUE(std::isnan(column(trace, "feed_mm_per_min")[0]));
  EXPECT_TRUE(std::isnan(column(trace, "bar_degC")[0]));
  EXPECT_EQ(column(trace, "sweep_s"), (std::vector{-1.5, -0.5, 0.5, 1.5}));
}

TEST(trace_of, of_nothing_is_empty) { EXPECT_TRUE(trace_of({}).time_s.empty()); }

std::string message_of(const std::vector<Recording>& recordings) {
  try {
    trace_of(recordings);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(trace_of, refuses_an_axial_recording_and_times_that_do_not_rise) {
  Recording axial;
  axial.kind = Kind::axial;
  axial.time_s = {0.0};
  axial.length_mm = {100.0};
  EXPECT_EQ(message_of({quarters(Direction::CCW), axial}),
            "recording 2: expected a circle, found an axial recording, which has no angles.");
  Recording standing = quarters(Direction::CCW);
  standing.time_s = {3.0, 4.0, 4.0, 9.0};
  EXPECT_EQ(message_of({standing}),
            "recording 1, reading 3: expected a time after the 4 s of the reading before it, found 4 s.");
}

// Every input of every effect on a recording finds its column, with a unit that the effect takes.
TEST(trace_column, serves_every_effect_on_a_recording) {
  const Series trace = trace_of(std::vector{quarters(Direction::CCW)});
  for (const auto& effect : built_in_catalogue()) {
    if (effect->level != Level::recording) continue;
    for (const Input& input : effect->inputs) {
      const std::string_view name = trace_column(input.role);
      EXPECT_NE(find_column(trace, name), nullptr) << effect->name << " " << input.role;
      for (const std::string& unit : input.units) {
        EXPECT_TRUE(unit == "1" ? unit_of(name).empty() : name.ends_with("_" + unit)) << effect->name << " " << name;
      }
    }
  }
  EXPECT_TRUE(trace_column("temperature").empty());
}

}  // namespace
}  // namespace ballbar
