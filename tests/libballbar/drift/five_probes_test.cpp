#include "ballbar/drift/five_probes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string_view>

#include "../made_series.hpp"
#include "numerics/random_streams.hpp"

namespace ballbar {
namespace {

constexpr double kGap = std::numeric_limits<double>::quiet_NaN();
constexpr double kRounding = 1e-9;  // um, urad: a few operations on numbers of order 100

// Three rows a minute apart, planes 60 mm apart. Changes since the first row:
//        X1   X2   Y1   Y2   Z
//   1     2    5   -1    5   7.5
//   2     3  6.6   -2    3  -1.5
Series probes() {
  Series series;
  series.time_s = {0.0, 60.0, 120.0};
  series.columns = {{"X1_um", Role::measured, {10.0, 12.0, 13.0}},
                    {"X2_um", Role::measured, {20.0, 25.0, 26.6}},
                    {"Y1_um", Role::measured, {5.0, 4.0, 3.0}},
                    {"Y2_um", Role::measured, {1.0, 6.0, 4.0}},
                    {"Z_um", Role::measured, {0.0, 7.5, -1.5}}};
  series.five_probe = FiveProbe{};
  series.five_probe->spacing_mm = 60.0;
  series.five_probe->resolution_um = 0.6;
  series.five_probe->linearity_percent = 3.0;
  return series;
}

Series without(Series series, std::initializer_list<std::string_view> names) {
  for (const std::string_view name : names) {
    std::erase_if(series.columns, [&](const Column& column) { return column.name == name; });
  }
  return series;
}

FivePointOptions at(double from_plane_1_mm) {
  FivePointOptions options;
  options.from_plane_1_mm = from_plane_1_mm;
  return options;
}

double value(const FivePoint& found, std::string_view axis, std::size_t row) {
  const DriftAxis* one = find_axis(found.drift, axis);
  return one == nullptr ? kGap : one->value[row];
}

double sigma(const FivePoint& found, std::string_view axis, std::string_view source, std::size_t row) {
  for (const Contribution& contribution : find_axis(found.drift, axis)->budget) {
    if (contribution.source == source) return contribution.sigma[row];
  }
  return kGap;
}

std::vector<std::string> names(const FivePoint& found) {
  std::vector<std::string> all;
  for (const DriftAxis& axis : found.drift.axes) all.push_back(axis.name + "_" + axis.unit);
  return all;
}

using Texts = std::vector<std::string>;

// What the 3 rows of probes() leave out as well.
const char* const kFewRows =
    "The probes' scatter is not in the uncertainty: 6 rows are needed to find it, there are 3.";

std::mt19937_64 random_of_this_test() {
  const std::string_view name = testing::UnitTest::GetInstance()->current_test_info()->name();
  return simulation::stream_of(1, simulation::Stream::probe, simulation::key_of(name));
}

// x(s) = X1 + (X2 - X1) s / 60, row 1: 2 + 3 s / 60; y: -1 + 6 s / 60; z at every s.
TEST(five_point, drift_along_the_bar) {
  struct {
    double s_mm, x_um, y_um;
  } const worked[] = {{0.0, 2.0, -1.0}, {20.0, 3.0, 1.0}, {60.0, 5.0, 5.0}, {90.0, 6.5, 8.0}, {-30.0, 0.5, -4.0}};
  for (const auto& [s_mm, x_um, y_um] : worked) {
    const FivePoint found = five_point(probes(), at(s_mm));
    EXPECT_NEAR(value(found, "x", 1), x_um, kRounding) << s_mm;
    EXPECT_NEAR(value(found, "y", 1), y_um, kRounding) << s_mm;
    EXPECT_NEAR(value(found, "z", 1), 7.5, kRounding) << s_mm;
    EXPECT_EQ(value(found, "x", 0), 0.0) << s_mm;
    EXPECT_EQ(find_axis(found.drift, "x")->unit, "um");
  }
}

// Row 1: B = (5 - 2) / 60 um/mm = 50 urad, A = -(5 + 1) / 60 = -100 urad. Row 2: B = 3.6 / 60 = 60, A = -5 / 60.
TEST(five_point, tilts_with_their_signs) {
  for (const double s_mm : {0.0, 20.0, -30.0}) {
    const FivePoint found = five_point(probes(), at(s_mm));
    EXPECT_NEAR(value(found, "tilt_b", 1), 50.0, kRounding);
    EXPECT_NEAR(value(found, "tilt_b", 2), 60.0, kRounding);
    EXPECT_NEAR(value(found, "tilt_a", 1), -100.0, kRounding);
    EXPECT_NEAR(value(found, "tilt_a", 2), -1e3 * 5.0 / 60.0, kRounding);
    EXPECT_EQ(names(found), (Texts{"x_um", "y_um", "z_um", "tilt_a_urad", "tilt_b_urad"}));
    EXPECT_EQ(texts_of(found.drift.remarks), Texts{kFewRows});
  }
}

TEST(five_point, what_and_when) {
  Series series = probes();
  EXPECT_EQ(five_point(series, at(-12.5)).drift.what, "five probes, -12.5 mm from plane 1");
  EXPECT_EQ(five_point(series).drift.time_s, series.time_s);
  EXPECT_EQ(five_point(series).drift.reference_s, 0.0);
  series.five_probe->spacing_mm.reset();
  EXPECT_EQ(five_point(series).drift.what, "five probes, at plane 1");
}

// The nearest row in which every probe has a reading is the zero: row 2 less row 1 is X1 +1, X2 +1.6.
TEST(five_point, reference_is_the_nearest_whole_row) {
  FivePointOptions options;
  options.reference_s = 80.0;
  FivePoint found = five_point(probes(), options);
  EXPECT_EQ(found.drift.reference_s, 60.0);
  EXPECT_NEAR(value(found, "x", 0), -2.0, kRounding);
  EXPECT_EQ(value(found, "x", 1), 0.0);
  EXPECT_NEAR(value(found, "x", 2), 1.0, kRounding);
  EXPECT_NEAR(value(found, "tilt_b", 2), 10.0, kRounding);

  Series gaps = probes();
  gaps.columns[4].values[1] = kGap;
  found = five_point(gaps, options);
  EXPECT_EQ(found.drift.reference_s, 120.0) << "60 s lacks Z, and 120 s is nearer to 80 s than 0 s";
  gaps.columns[3].values[0] = kGap;
  EXPECT_EQ(five_point(gaps).drift.reference_s, 120.0) << "the first whole row";
}

TEST(five_point, a_gap_leaves_out_what_needs_it) {
  Series series = probes();
  series.columns[1].values[1] = kGap;  // X2
  const FivePoint between = five_point(series, at(20.0));
  EXPECT_TRUE(std::isnan(value(between, "x", 1)));
  EXPECT_TRUE(std::isnan(value(between, "tilt_b", 1)));
  EXPECT_NEAR(value(between, "y", 1), 1.0, kRounding);
  EXPECT_NEAR(value(between, "x", 2), 3.0 + 3.6 / 3.0, kRounding);
  EXPECT_NEAR(value(five_point(series), "x", 1), 2.0, kRounding) << "at plane 1 X1 is enough";
}

TEST(five_point, without_the_spacing_the_difference_stands_for_the_tilt) {
  Series series = probes();
  series.five_probe->spacing_mm.reset();
  const FivePoint found = five_point(series);
  EXPECT_EQ(names(found), (Texts{"x_um", "y_um", "z_um", "y2_minus_y1_um", "x2_minus_x1_um"}));
  EXPECT_NEAR(value(found, "x", 1), 2.0, kRounding);
  EXPECT_NEAR(value(found, "y2_minus_y1", 1), 6.0, kRounding);
  EXPECT_NEAR(value(found, "x2_minus_x1", 1), 3.0, kRounding);
  EXPECT_EQ(texts_of(found.drift.remarks),
            (Texts{"Tilt A is not known: the spacing of the probes' planes is not stated (spacing_mm under "
                   "[five_probe]); the difference Y2 - Y1 stands in its place.",
                   "Tilt B is not known: the spacing of the probes' planes is not stated (spacing_mm under "
                   "[five_probe]); the difference X2 - X1 stands in its place.",
                   kFewRows}));
}

TEST(five_point, one_probe_missing) {
  struct {
    const char* missing;
    Texts axes, remarks;
  } const cases[] = {
      {"X1_um",
       {"y_um", "z_um", "tilt_a_urad"},
       {"x is not known 20 mm from plane 1: X1 is missing; it is known at plane 2, 60 mm from plane 1.",
        "Tilt B is not known: there is no X1.", kFewRows}},
      {"X2_um",
       {"y_um", "z_um", "tilt_a_urad"},
       {"x is not known 20 mm from plane 1: X2 is missing; it is known at plane 1, 0 mm from plane 1.",
        "Tilt B is not known: there is no X2.", kFewRows}},
      {"Y1_um",
       {"x_um", "z_um", "tilt_b_urad"},
       {"y is not known 20 mm from plane 1: Y1 is missing; it is known at plane 2, 60 mm from plane 1.",
        "Tilt A is not known: there is no Y1.", kFewRows}},
      {"Y2_um",
       {"x_um", "z_um", "tilt_b_urad"},
       {"y is not known 20 mm from plane 1: Y2 is missing; it is known at plane 1, 0 mm from plane 1.",
        "Tilt A is not known: there is no Y2.", kFewRows}},
      {"Z_um", {"x_um", "y_um", "tilt_a_urad", "tilt_b_urad"}, {"z is not known: there is no Z.", kFewRows}},
  };
  for (const auto& [missing, axes, remarks] : cases) {
    const FivePoint found = five_point(without(probes(), {missing}), at(20.0));
    EXPECT_EQ(names(found), axes) << missing;
    EXPECT_EQ(texts_of(found.drift.remarks), remarks) << missing;
  }
}

// A probe knows the drift of its own plane without its partner.
TEST(five_point, one_probe_of_a_pair_in_its_own_plane) {
  const FivePoint plane_1 = five_point(without(probes(), {"X2_um", "Y2_um"}));
  EXPECT_NEAR(value(plane_1, "x", 1), 2.0, kRounding);
  EXPECT_NEAR(value(plane_1, "y", 1), -1.0, kRounding);
  EXPECT_EQ(texts_of(plane_1.drift.remarks),
            (Texts{"Tilt A is not known: there is no Y2.", "Tilt B is not known: there is no X2.", kFewRows}));
  const FivePoint plane_2 = five_point(without(probes(), {"X1_um", "Y1_um"}), at(60.0));
  EXPECT_NEAR(value(plane_2, "x", 1), 5.0, kRounding);
  EXPECT_NEAR(value(plane_2, "y", 1), 5.0, kRounding);
}

TEST(five_point, only_x2) {
  Series series = without(probes(), {"X1_um", "Y1_um", "Y2_um", "Z_um"});
  FivePoint found = five_point(series, at(60.0));
  EXPECT_EQ(names(found), Texts{"x_um"});
  EXPECT_NEAR(value(found, "x", 1), 5.0, kRounding);
  const Texts others = {"y is not known: there is neither Y1 nor Y2.", "z is not known: there is no Z.",
                        "Tilt A is not known: there is no Y1.", "Tilt B is not known: there is no X1.", kFewRows};
  EXPECT_EQ(texts_of(found.drift.remarks), others);

  series.five_probe.reset();
  found = five_point(series);
  EXPECT_TRUE(found.drift.axes.empty());
  Texts remarks = others;
  remarks.insert(remarks.begin(),
                 "x is not known 0 mm from plane 1: X1 is missing; it is known at plane 2, whose distance from plane 1 "
                 "is not stated.");
  remarks.emplace_back(
      "The uncertainty does not include the probes' resolution (resolution_um) and linearity (linearity_percent), "
      "which "
      "[five_probe] does not state.");
  EXPECT_EQ(texts_of(found.drift.remarks), remarks);
}

TEST(five_point, what_the_file_does_not_state_is_said) {
  Series series = probes();
  series.five_probe->linearity_percent.reset();
  EXPECT_EQ(
      texts_of(five_point(series).drift.remarks),
      (Texts{kFewRows,
             "The uncertainty does not include the probes' linearity (linearity_percent), which [five_probe] does "
             "not state."}));
  series = probes();
  series.five_probe->resolution_um.reset();
  EXPECT_EQ(
      texts_of(five_point(series).drift.remarks),
      (Texts{kFewRows,
             "The uncertainty does not include the probes' resolution (resolution_um), which [five_probe] does not "
             "state."}));
}

TEST(five_point, columns_of_other_names) {
  Series series = probes();
  series.columns[0].name = "near_um";
  EXPECT_EQ(names(five_point(series, at(20.0))), (Texts{"y_um", "z_um", "tilt_a_urad"}));
  series.five_probe->columns[0] = "near_um";
  EXPECT_NEAR(value(five_point(series, at(20.0)), "x", 1), 3.0, kRounding);
}

TEST(five_point, whether_a_series_is_of_five_probes) {
  EXPECT_TRUE(is_five_probe(probes()));
  Series series = without(probes(), {"X1_um", "X2_um", "Y1_um", "Y2_um"});
  series.five_probe.reset();
  EXPECT_FALSE(is_five_probe(series)) << "Z alone may be a drift";
  EXPECT_FALSE(is_five_probe(without(series, {"Z_um"})));
  series = without(series, {"Z_um"});
  series.five_probe = FiveProbe{};
  EXPECT_TRUE(is_five_probe(series)) << "the table alone";
}

TEST(five_point, errors) {
  struct {
    const char* message;
    std::function<void(Series&, FivePointOptions&)> spoil;
  } const cases[] = {
      {"expected a column of its own for each probe, found X1_um for X1 and Y2.",
       [](Series& s, FivePointOptions&) { s.five_probe->columns[3] = "X1_um"; }},
      {"expected readings in um for the probe X1, found the column X1_mm.",
       [](Series& s, FivePointOptions&) { s.columns[0].name = s.five_probe->columns[0] = "X1_mm"; }},
      {"expected readings in um for the probe Z, found the column Z.",
       [](Series& s, FivePointOptions&) { s.columns[4].name = s.five_probe->columns[4] = "Z"; }},
      {"expected a column of a probe, one of X1_um, X2_um, Y1_um, Y2_um, Z_um, found none.",
       [](Series& s, FivePointOptions&) {
         s.columns = {{"T_degC", Role::structure, {1.0, 2.0, 3.0}}};
       }},
      {"expected a column of a probe, one of a_um, X2_um, Y1_um, Y2_um, Z_um, found none.",
       [](Series& s, FivePointOptions&) {
         s.columns.clear();
         s.five_probe->columns[0] = "a_um";
       }},
      {"expected the spacing of the probes' planes, which a drift -12.5 mm from plane 1 needs, found none: state "
       "spacing_mm under [five_probe].",
       [](Series& s, FivePointOptions& o) {
         s.five_probe->spacing_mm.reset();
         o.from_plane_1_mm = -12.5;
       }},
      {"expected a row in which every probe has a reading, as the reference, found none.",
       [](Series& s, FivePointOptions&) {
         s.columns[0].values[0] = s.columns[2].values[1] = s.columns[4].values[2] = kGap;
       }},
      {"expected a row in which every probe has a reading, as the reference, found none.",
       [](Series& s, FivePointOptions&) {
         s.time_s.clear();
         for (Column& column : s.columns) column.values.clear();
       }},
  };
  for (const auto& [message, spoil] : cases) {
    Series series = probes();
    FivePointOptions options;
    spoil(series, options);
    made::expect_error(message, [&] { five_point(series, options); });
  }
}

// Row 1 at s = 20 mm of d = 60 mm: w = 2/3 and 1/3, sum w^2 = 5/9; tilt: w = 1000/60 urad/um, sum w^2 = 5000/9.
//   resolution 0.6 um: q^2/12 = 0.03 um^2: x sqrt(2 * 0.03 * 5/9) = sqrt(1/30) um, tilt sqrt(2 * 0.03 * 5000/9) urad
//   linearity 3 %: errors 0.03 * 2/3 * 2 and 0.03 * 1/3 * 5: x 0.03 sqrt((16 + 25) / 9 / 3) um,
//                  tilt 0.03 * 1000/60 sqrt((4 + 25) / 3) urad; z 0.03 * 7.5 / sqrt(3) um
//   ball's place to 2 mm: tilt B 0.05 um/mm: 0.1 um; tilt A 0.1 um/mm: y 0.2 um
TEST(five_point, budget_by_hand) {
  FivePointOptions options = at(20.0);
  options.from_plane_1_sigma_mm = 2.0;
  const FivePoint found = five_point(probes(), options);
  EXPECT_NEAR(sigma(found, "x", "probe resolution", 1), std::sqrt(1.0 / 30.0), kRounding);
  EXPECT_NEAR(sigma(found, "tilt_b", "probe resolution", 1), std::sqrt(0.06 * 5000.0 / 9.0), kRounding);
  EXPECT_NEAR(sigma(found, "z", "probe resolution", 1), std::sqrt(0.06), kRounding);
  EXPECT_NEAR(sigma(found, "x", "probe linearity", 1), 0.03 * std::sqrt(41.0 / 27.0), kRounding);
  EXPECT_NEAR(sigma(found, "tilt_b", "probe linearity", 1), 0.5 * std::sqrt(29.0 / 3.0), kRounding);
  EXPECT_NEAR(sigma(found, "z", "probe linearity", 1), 0.225 / std::sqrt(3.0), kRounding);
  EXPECT_NEAR(sigma(found, "x", "place of the ball", 1), 0.1, kRounding);
  EXPECT_NEAR(sigma(found, "y", "place of the ball", 1), 0.2, kRounding);
  EXPECT_TRUE(std::isnan(sigma(found, "z", "place of the ball", 1)));
  EXPECT_TRUE(std::isnan(sigma(found, "tilt_b", "place of the ball", 1)));
  EXPECT_TRUE(std::isnan(sigma(found, "x", "probe scatter", 1))) << "3 rows do not show it";
  EXPECT_NEAR(sigma_of(*find_axis(found.drift, "x"), 1), std::sqrt(1.0 / 30.0 + 0.0009 * 41.0 / 27.0 + 0.01),
              kRounding);
  for (const DriftAxis& axis : found.drift.axes) EXPECT_EQ(sigma_of(axis, 0), 0.0) << axis.name << " at the reference";
}

// A ball in a plane of the probes may be known no better: one probe gives the drift, the pair its share of u_s.
TEST(five_point, place_of_the_ball_in_a_plane_of_the_probes) {
  FivePointOptions options;
  options.from_plane_1_sigma_mm = 2.0;
  for (const double s_mm : {0.0, 60.0}) {
    options.from_plane_1_mm = s_mm;
    const FivePoint found = five_point(probes(), options);
    EXPECT_NEAR(sigma(found, "x", "place of the ball", 1), 0.1, kRounding);
    EXPECT_NEAR(sigma(found, "y", "place of the ball", 1), 0.2, kRounding);
    EXPECT_NEAR(sigma(found, "x", "probe resolution", 1), std::sqrt(0.06), kRounding) << "of one probe";
    EXPECT_EQ(sigma(found, "x", "place of the ball", 0), 0.0);
  }
  options.from_plane_1_mm = 0.0;
  const FivePoint found = five_point(without(probes(), {"X2_um"}), options);
  EXPECT_TRUE(std::isnan(sigma(found, "x", "place of the ball", 1)));
  EXPECT_EQ(texts_of(found.drift.remarks),
            (Texts{"The place of the ball is not in the uncertainty of x: tilt B is not known.",
                   "Tilt B is not known: there is no X2.", kFewRows}));
}

Series one_probe(std::vector<double> time_s, std::vector<double> z_um) {
  Series series;
  series.time_s = std::move(time_s);
  series.columns = {{"Z_um", Role::measured, std::move(z_um)}};
  return series;
}

// Even rows 0 3 0 3 0 3: each of the 4 inner readings is 3 um off the line between its neighbours, of which the
// squared weights are 1 + 1/4 + 1/4: sqrt(9 / 1.5). Rows at 0, 1, 4, 5, 8, 9 s alternate between w = 1/4 and 3/4, and
// 1 + 1/16 + 9/16 = 26/16; values 0 0 4 0 0 0: off by -1, 4, -3 and 0, squares 26 * 16/26 / 4 = 4: 2 um.
TEST(five_point, scatter_by_hand) {
  const FivePoint even = five_point(one_probe({0, 1, 2, 3, 4, 5}, {0, 3, 0, 3, 0, 3}));
  EXPECT_NEAR(even.scatter_um[4].value(), std::sqrt(6.0), kRounding);
  EXPECT_NEAR(sigma(even, "z", "probe scatter", 3), std::sqrt(12.0), kRounding) << "of a difference of two readings";
  EXPECT_FALSE(even.scatter_um[0].has_value());
  const FivePoint uneven = five_point(one_probe({0, 1, 4, 5, 8, 9}, {0, 0, 4, 0, 0, 0}));
  EXPECT_NEAR(uneven.scatter_um[4].value(), 2.0, kRounding);
  EXPECT_FALSE(five_point(one_probe({0, 1, 2, 3, 4}, {0, 3, 0, 3, 0})).scatter_um[4].has_value()) << "3 neighbours";
  const FivePoint gap = five_point(one_probe({0, 1, 2, 3, 4, 5, 6, 7, 8}, {0, 3, 0, 3, kGap, 3, 0, 3, 0}));
  EXPECT_NEAR(gap.scatter_um[4].value(), std::sqrt(6.0), kRounding) << "4 neighbours without the gap";
  EXPECT_EQ(text_of(gap.drift.remarks.back()).find("scatter"), std::string::npos);
  const FivePoint gaps = five_point(one_probe({0, 1, 2, 3, 4, 5}, {0, 3, 0, kGap, 0, 3}));
  const std::string few =
      "The scatter of Z is not in the uncertainty: gaps leave fewer than 4 readings between two others.";
  const Texts remarks = texts_of(gaps.drift.remarks);
  EXPECT_EQ(std::count(remarks.begin(), remarks.end(), few), 1);
  const FivePoint line = five_point(one_probe({0, 1, 4, 5, 8, 9}, {0, 2, 8, 10, 16, 18}));
  EXPECT_EQ(line.scatter_um[4].value(), 0.0) << "drift along a straight line is none";
}

// 20000 rows of white noise on a drift of 40 um: the estimate scatters by 0.7 % (second differences overlap: the
// variance of their mean square is 2 * 1.94 / n), the cut at 95 % adds a little.
TEST(five_point, scatter_of_known_white_noise) {
  struct {
    const char* what;
    double noise_um, resolution_um;
    std::array<double, 3> steps_s;
    double outlier_um;
    double expected_um, tolerance;  // of the scatter, relative
  } const cases[] = {
      {"even", 0.3, 0.0, {10.0, 10.0, 10.0}, 0.0, 0.3, 0.03},
      {"uneven steps", 0.3, 0.0, {10.0, 50.0, 3.0}, 0.0, 0.3, 0.03},
      {"quantised: sqrt(n^2 + q^2 / 12)", 0.1, 0.2, {10.0, 10.0, 10.0}, 0.0, std::sqrt(0.01 + 0.04 / 12.0), 0.03},
      // One reading in 100 spoils three differences in 100; the cut takes them and some of the largest sound ones.
      {"outliers of 50 um", 0.3, 0.0, {10.0, 10.0, 10.0}, 50.0, 0.3, 0.10},
  };
  std::mt19937_64 random = random_of_this_test();
  for (const auto& one : cases) {
    std::vector<double> time_s, z_um;
    double now_s = 0.0;
    for (std::size_t i = 0; i < 20'000; ++i) {
      const double drift_um = 20.0 * std::sin(static_cast<double>(i) / 3000.0) + (i % 100 == 99 ? one.outlier_um : 0.0);
      time_s.push_back(now_s);
      z_um.push_back(simulation::rounded(drift_um + one.noise_um * simulation::normal(random), one.resolution_um));
      now_s += one.steps_s[i % 3];
    }
    Series series = one_probe(time_s, z_um);
    series.five_probe = FiveProbe{};
    if (one.resolution_um > 0.0) series.five_probe->resolution_um = one.resolution_um;
    const FivePoint found = five_point(series);
    EXPECT_NEAR(found.scatter_um[4].value(), one.expected_um, one.tolerance * one.expected_um) << one.what;
    // The part that the resolution explains is counted once, as resolution.
    const double noise_um = std::sqrt(2.0) * one.noise_um;
    EXPECT_NEAR(sigma(found, "z", "probe scatter", 7), noise_um, 1.5 * one.tolerance * noise_um) << one.what;
  }
}

// The law of propagation against 40000 draws of what it stands for: white noise, quantised readings at an offset of
// any phase, a gain error of each probe uniform within the linearity, the ball off its stated place. The standard
// deviation of so many draws is known to 0.35 %, the scatter found in the file to 0.7 %, so 3 % is four sigma.
TEST(five_point, law_of_propagation_against_draws) {
  constexpr std::array kDrift_um{20.0, 32.0};  // of plane 1 and 2: tilt 0.2 um/mm
  constexpr double kSpacing_mm = 60.0, kPlace_mm = 20.0, kPlaceSigma_mm = 0.5;
  constexpr double kNoise_um = 0.1, kResolution_um = 0.2, kLinearity_percent = 0.5;
  constexpr std::size_t kDraws = 40'000, kRows = 20'000;
  std::mt19937_64 random = random_of_this_test();

  Series series;
  series.five_probe = FiveProbe{};
  series.five_probe->spacing_mm = kSpacing_mm;
  series.five_probe->resolution_um = kResolution_um;
  series.five_probe->linearity_percent = kLinearity_percent;
  FivePointOptions options = at(kPlace_mm);
  options.from_plane_1_sigma_mm = kPlaceSigma_mm;

  // Readings of the file: the drift is the last row's, told exactly; what comes before shows the scatter.
  Series file = series;
  for (std::size_t row = 0; row < kRows; ++row) file.time_s.push_back(static_cast<double>(row));
  for (std::size_t plane = 0; plane < 2; ++plane) {
    Column column{plane == 0 ? "X1_um" : "X2_um", Role::measured, {0.0}};
    for (std::size_t row = 1; row + 1 < kRows; ++row) {
      const double drift_um = kDrift_um[plane] * static_cast<double>(row) / kRows;
      column.values.push_back(simulation::rounded(drift_um + kNoise_um * simulation::normal(random), kResolution_um));
    }
    column.values.push_back(kDrift_um[plane]);
    file.columns.push_back(std::move(column));
  }
  const FivePoint stated = five_point(file, options);
  const double sigma_x_um = sigma_of(*find_axis(stated.drift, "x"), kRows - 1);
  const double sigma_b_urad = sigma_of(*find_axis(stated.drift, "tilt_b"), kRows - 1);

  series.time_s = {0.0, 1.0};
  series.columns = {{"X1_um", Role::measured, {0.0, 0.0}}, {"X2_um", Role::measured, {0.0, 0.0}}};
  const double true_b = (kDrift_um[1] - kDrift_um[0]) / kSpacing_mm;
  double squares_x = 0.0, squares_b = 0.0;
  for (std::size_t draw = 0; draw < kDraws; ++draw) {
    for (std::size_t plane = 0; plane < 2; ++plane) {
      const double offset_um = simulation::uniform(random) * kResolution_um;
      const double gain = 1.0 + kLinearity_percent / 100.0 * (2.0 * simulation::uniform(random) - 1.0);
      for (std::size_t row = 0; row < 2; ++row) {
        const double true_um = offset_um + (row == 0 ? 0.0 : gain * kDrift_um[plane]);
        series.columns[plane].values[row] =
            simulation::rounded(true_um + kNoise_um * simulation::normal(random), kResolution_um);
      }
    }
    const FivePoint found = five_point(series, options);
    const double ball_mm = kPlace_mm + kPlaceSigma_mm * simulation::normal(random);
    const double error_x = value(found, "x", 1) - (kDrift_um[0] + true_b * ball_mm);
    const double error_b = value(found, "tilt_b", 1) - 1e3 * true_b;
    squares_x += error_x * error_x;
    squares_b += error_b * error_b;
  }
  EXPECT_NEAR(std::sqrt(squares_x / kDraws), sigma_x_um, 0.03 * sigma_x_um);
  EXPECT_NEAR(std::sqrt(squares_b / kDraws), sigma_b_urad, 0.03 * sigma_b_urad);
}

DriftAxis axis_of(std::vector<double> values, std::vector<double> sigma) {
  return {"x", "um", std::move(values), {{"probe scatter", std::move(sigma)}}};
}

void expect_range(const std::optional<Estimate>& range, double value_um, double sigma_um) {
  ASSERT_TRUE(range.has_value());
  EXPECT_NEAR(range->value_um, value_um, kRounding);
  EXPECT_NEAR(range->sigma_um, sigma_um, kRounding);
}

// Minutes 0, 30, 60 | 61, 120: 0 2 1 | 5 3. First hour 2 - 0, after 5 - 3, total 5 - 0, first to last 3 - 0.
TEST(range_of, first_hour_after_total_and_end) {
  const std::vector<double> time_s = {0.0, 1800.0, 3600.0, 3660.0, 7200.0};
  const DriftAxis axis = axis_of({0.0, 2.0, 1.0, 5.0, 3.0}, {0.0, 0.3, 0.3, 0.4, 0.3});
  const DriftRange all = range_of(axis, time_s, 0, 5);
  expect_range(all.first_60_min, 2.0, 0.3);
  expect_range(all.after_60_min, 2.0, 0.5);  // hypot(0.3, 0.4)
  expect_range(all.total, 5.0, 0.4);
  expect_range(all.at_end, 3.0, 0.3);

  // From minute 30 on, of which 60 and 61 are in the first hour, and not the last row: 2 1 5.
  const DriftRange part = range_of(axis, time_s, 1, 4);
  expect_range(part.first_60_min, 4.0, 0.5);
  EXPECT_FALSE(part.after_60_min.has_value());
  expect_range(part.total, 4.0, 0.5);
  expect_range(part.at_end, 3.0, 0.5);
}

// A gain error of 3 % moves readings of -5 and +5 um apart by 0.3 um / sqrt(3): sqrt(2) more than the two added as
// independent, 0.15 um sqrt(2) / sqrt(3).
TEST(range_of, probe_linearity_of_opposite_signs) {
  const double one_um = 0.15 / std::sqrt(3.0);
  const DriftRange all = range_of(axis_of({0.0, -5.0, 5.0}, {0.0, one_um, one_um}), {0.0, 60.0, 120.0}, 0, 3);
  expect_range(all.total, 10.0, 0.3 / std::sqrt(3.0) / std::sqrt(2.0));
}

TEST(range_of, a_drift_that_falls) {
  const DriftRange all = range_of(axis_of({0.0, -4.0, -1.0}, {0.0, 0.3, 0.4}), {0.0, 60.0, 120.0}, 0, 3);
  expect_range(all.total, 4.0, 0.3);
  expect_range(all.at_end, -1.0, 0.4);
}

TEST(range_of, gaps_and_single_rows) {
  const std::vector<double> time_s = {0.0, 60.0, 120.0};
  const DriftRange one = range_of(axis_of({kGap, 2.0, kGap}, {0.0, 0.3, 0.3}), time_s, 0, 3);
  expect_range(one.total, 0.0, 0.0);
  expect_range(one.at_end, 0.0, 0.0);
  EXPECT_FALSE(one.after_60_min.has_value());
  const DriftRange two = range_of(axis_of({kGap, 2.0, 7.0}, {0.0, 0.3, 0.4}), time_s, 0, 3);
  expect_range(two.at_end, 5.0, 0.5);
  const DriftRange none = range_of(axis_of({kGap, kGap, kGap}, {0.0, 0.3, 0.3}), time_s, 0, 3);
  EXPECT_FALSE(none.total.has_value());
  EXPECT_FALSE(none.at_end.has_value());
  EXPECT_FALSE(range_of(axis_of({1.0, 2.0, 3.0}, {0.0, 0.3, 0.3}), time_s, 2, 2).total.has_value()) << "no rows";
  EXPECT_TRUE(std::isnan(range_of({"x", "um", {0.0, 1.0, 2.0}, {}}, time_s, 0, 3).total->sigma_um)) << "not stated";
}

}  // namespace
}  // namespace ballbar
