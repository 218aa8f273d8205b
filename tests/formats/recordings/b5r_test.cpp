#include "ballbar/formats/recordings/b5r.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>

#include "bad_text.hpp"
#include "ballbar/error.hpp"
#include "ballbar/units.hpp"

namespace ballbar {
namespace {

// Angles pass through degrees and back: a few units in the last place of 2 pi.
constexpr double kRounding_rad = 1e-14;

TEST(b5r, readings_become_lengths_at_mid_sample_angles) {
  const B5r test = read_b5r(good_text("b5r"), "file");
  EXPECT_EQ(test.test_name, "quarter & turn");
  EXPECT_EQ(test.ballbar_model, "QC20-W");
  EXPECT_EQ(test.software_version, "5.1");
  EXPECT_EQ(test.programmed_feed_mm_per_min, 1000.0);
  ASSERT_EQ(test.runs.size(), 1u);
  const Recording& run = test.runs[0];
  EXPECT_EQ(run.kind, Kind::circle);
  EXPECT_EQ(run.motion, Motion::linear_axes);
  EXPECT_EQ(run.moving_ball, MovingBall::spindle);
  EXPECT_EQ(run.plane, Plane::ZX);
  EXPECT_EQ(run.direction, Direction::CW);
  EXPECT_EQ(run.nominal_length_mm, 100.0);
  EXPECT_EQ(run.bar_temperature_degC, 21.5);
  EXPECT_TRUE(run.time_s.empty());
  // 29 February 2020 is day 18262 + 59 of the epoch; 12:00:01 is 43201 s into it.
  EXPECT_EQ(run.started_s, std::int64_t{18321} * 86400 + 43201);
  // START_INDEX 1 to END_INDEX 3 leaves out the first and the last reading.
  EXPECT_EQ(run.length_mm, (std::vector<double>{100.0 + 0.001, 100.0 - 0.002, 100.0 + 0.003}));
  // 350 to 80 deg is an arc of 90; three readings of 30 deg each, clockwise from 440: 425, 395, 365.
  ASSERT_EQ(run.angle_rad.size(), 3u);
  EXPECT_NEAR(run.angle_rad[0], rad_from_deg(425.0), kRounding_rad);
  EXPECT_NEAR(run.angle_rad[1], rad_from_deg(395.0), kRounding_rad);
  EXPECT_NEAR(run.angle_rad[2], rad_from_deg(365.0), kRounding_rad);
  // A quarter of 2 pi 100 mm in 0.3 s: 50 pi / 0.3 * 60 = 10000 pi mm/min; three roundings.
  EXPECT_NEAR(*run.feed_mm_per_min, 10000.0 * kPi, 1e-10);
}

TEST(b5r, counter_clockwise_starts_at_start_angle) {
  const B5r test = read_b5r(changed("b5r", "<RUN_DIRECTION>CW", "<RUN_DIRECTION>CCW"), "file");
  EXPECT_NEAR(test.runs[0].angle_rad[0], rad_from_deg(365.0), kRounding_rad);
  EXPECT_NEAR(test.runs[0].angle_rad[2], rad_from_deg(425.0), kRounding_rad);
}

TEST(b5r, equal_start_and_end_angle_is_a_full_circle) {
  const B5r test = read_b5r(changed("b5r", "<END_ANGLE>80", "<END_ANGLE>350"), "file");
  // Three readings of 120 deg, clockwise from 710: 650, 530, 410.
  EXPECT_NEAR(test.runs[0].angle_rad[0], rad_from_deg(650.0), kRounding_rad);
  EXPECT_NEAR(test.runs[0].angle_rad[2], rad_from_deg(410.0), kRounding_rad);
}

TEST(b5r, stored_values_are_found_by_parent_name_and_unit) {
  const B5r test = read_b5r(good_text("b5r"), "file");
  ASSERT_EQ(test.stored.size(), 4u);
  EXPECT_EQ(stored_value(test, "run 0", "AF_BEST_RADIUS", "UT_LENGTH_MM"), 100.0007);
  EXPECT_EQ(stored_value(test, "ISO230_4 2005", "AF_BEST_RADIUS", "UT_LENGTH_UM"), 0.7);
  EXPECT_EQ(stored_value(test, "ANSI_B_5_57", "AF_RANK", "UT_RANKING"), 2.0);
  EXPECT_EQ(stored_value(test, "run 0", "AF_BEST_RADIUS", "UT_LENGTH_UM"), std::nullopt);
  EXPECT_EQ(stored_value(test, "ISO230_4 2005", "AF_SIN", "UT_LENGTH_UM"), std::nullopt);  // not valid
}

TEST(b5r, deep_nesting_is_only_a_missing_element) {
  std::string text = "<TEST_DOCUMENT>";
  constexpr int kDepth = 200000;
  for (int i = 0; i < kDepth; ++i) text += "<a>";
  for (int i = 0; i < kDepth; ++i) text += "</a>";
  text += "</TEST_DOCUMENT>";
  EXPECT_THROW(read_b5r(text, "file"), Error);
}

// The axes' names decide: of the plane XZ whose axes are called Z and X, it is Z that the angle begins at.
TEST(b5r, the_plane_is_that_of_the_axes_names) {
  const B5r by_names = read_b5r(changed("b5r", "TEST_PLANE=\"ZX\"", "TEST_PLANE=\"XZ\""), "file");
  EXPECT_EQ(by_names.plane, Plane::ZX);
  ASSERT_EQ(by_names.remarks.size(), 2u);  // one of the run that misses
  EXPECT_EQ(by_names.remarks.front(),
            "file:11:24: expected the axes X and Z of the plane XZ, found Z first. The file is read as the plane ZX.");
  std::string text = changed("b5r", "TEST_PLANE=\"ZX\"", "TEST_PLANE=\"XZ\"");
  text.replace(text.find(">Z</A_AXIS_NAME>"), 2, ">X");
  text.replace(text.find(">X</B_AXIS_NAME>"), 2, ">Z");
  const B5r exchanged = read_b5r(text, "file");
  EXPECT_EQ(exchanged.plane, Plane::XZ);
  EXPECT_EQ(axes_of(exchanged.plane), (std::array{0, 2}));
}

// A test of any plane, arc and reading count, both directions, with names that need escaping.
B5r arbitrary_test() {
  B5r test;
  test.test_name = *rc::gen::string<std::string>();
  std::erase_if(test.test_name,
                [](char c) { return static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) > 0x7E; });
  test.ballbar_model = "<QC & \"20\">";
  test.software_version = "1.0";
  const auto n = *rc::gen::inRange<std::size_t>(2, 200);
  const int start_deg = *rc::gen::inRange(0, 360);
  const int arc_deg = *rc::gen::inRange(1, 361);
  for (const Direction direction : {Direction::CCW, Direction::CW}) {
    Recording run;
    run.plane = *rc::gen::element(Plane::XY, Plane::YZ, Plane::ZX, Plane::YX, Plane::ZY, Plane::XZ);
    if (!test.runs.empty()) run.plane = test.runs[0].plane;
    run.direction = direction;
    run.nominal_length_mm = test.runs.empty() ? *rc::gen::element(50.0, 100.0, 150.25) : test.runs[0].nominal_length_mm;
    run.feed_mm_per_min = *rc::gen::inRange(1, 20000);
    run.started_s = *rc::gen::inRange<std::int64_t>(0, 4000000000);
    if (!test.runs.empty()) run.started_s = test.runs[0].started_s;
    run.bar_temperature_degC = *rc::gen::inRange(-100, 500) / 10.0;
    for (std::size_t i = 0; i < n; ++i) {
      const double travelled_deg = (static_cast<double>(i) + 0.5) * arc_deg / static_cast<double>(n);
      run.angle_rad.push_back(
          rad_from_deg(direction == Direction::CCW ? start_deg + travelled_deg : start_deg + arc_deg - travelled_deg));
      run.length_mm.push_back(run.nominal_length_mm + *rc::gen::inRange(-1000000, 1000000) * 1e-6);
    }
    test.runs.push_back(run);
  }
  test.stored = {{"run 1", "AF_BEST_RADIUS", "UT_LENGTH_MM", 100.1, true},
                 {"ISO230_4 1996", "AF_G", "UT_LENGTH_UM", -1.25e-7, false},
                 {"ANSI", "AF_G", "UT_LENGTH_UM", 3.0, true}};
  return test;
}

TEST(b5r, written_and_read_again_is_the_same_to_half_the_last_decimal) {
  const bool passed = rc::check([] {
    const B5r test = arbitrary_test();
    const B5r again = read_b5r(write_b5r(test, *rc::gen::inRange<std::size_t>(0, 5)), "file");
    RC_ASSERT(again.test_name == test.test_name);
    RC_ASSERT(again.ballbar_model == test.ballbar_model);
    RC_ASSERT(again.runs.size() == test.runs.size());
    for (std::size_t i = 0; i < test.runs.size(); ++i) {
      const Recording& left = test.runs[i];
      const Recording& right = again.runs[i];
      RC_ASSERT(right.plane == left.plane);
      RC_ASSERT(right.direction == left.direction);
      RC_ASSERT(right.nominal_length_mm == left.nominal_length_mm);
      RC_ASSERT(right.started_s == left.started_s);
      RC_ASSERT(right.bar_temperature_degC == left.bar_temperature_degC);
      // START_ANGLE is written to 1e-7 deg; feed is a quotient of it.
      RC_ASSERT(std::abs(*right.feed_mm_per_min / *left.feed_mm_per_min - 1.0) < 1e-6);
      RC_ASSERT(right.length_mm.size() == left.length_mm.size());
      for (std::size_t k = 0; k < left.length_mm.size(); ++k) {
        // Half of the fifth decimal, and the rounding of 100 mm in a double.
        RC_ASSERT(std::abs(right.length_mm[k] - left.length_mm[k]) <= 0.5e-5 + 1e-13);
        RC_ASSERT(std::abs(std::remainder(right.angle_rad[k] - left.angle_rad[k], 2.0 * kPi)) < 1e-8);
      }
    }
    RC_ASSERT(again.stored.size() == test.stored.size());
    RC_ASSERT(stored_value(again, "run 1", "AF_BEST_RADIUS", "UT_LENGTH_MM") == 100.1);
    RC_ASSERT(stored_value(again, "ANSI", "AF_G", "UT_LENGTH_UM") == 3.0);
    const auto invalid = std::find_if(again.stored.begin(), again.stored.end(),
                                      [](const StoredFeature& stored) { return !stored.valid; });
    RC_ASSERT(invalid->parent == "ISO230_4 1996");
    RC_ASSERT(invalid->value == -1.25e-7);
  });
  EXPECT_TRUE(passed);
}

TEST(b5r, writer_refuses_what_the_format_cannot_hold) {
  const auto message = [](const B5r& test) {
    try {
      write_b5r(test);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("no complaint");
  };
  B5r test;
  EXPECT_EQ(message(test), "a .b5r file is written from at least one run or stored result, found none.");
  test = read_b5r(good_text("b5r"), "file");
  EXPECT_EQ(message(test), "no complaint");
  B5r other_plane = test;
  other_plane.runs.push_back(test.runs[0]);
  other_plane.runs[1].plane = Plane::XY;
  EXPECT_EQ(message(other_plane),
            "the runs of a .b5r file share plane, nominal length, start and end angle, found runs that differ.");
  B5r axial = test;
  axial.runs[0].kind = Kind::axial;
  EXPECT_EQ(message(axial), "a .b5r file is written from circles of at least two readings, found another recording.");
  B5r undated = test;
  undated.runs[0].started_s.reset();
  EXPECT_EQ(message(undated), "a .b5r file states when a run started and its feed, found a run without.");
}

}  // namespace
}  // namespace ballbar
