#include "ballbar/drift/thermal_test.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <span>
#include <string>
#include <vector>

namespace ballbar {
namespace {

constexpr double kHour_s = 3600.0;

// A row a minute; `value` of the time in min.
template <class Value>
Column column_of(std::string name, Role role, std::size_t minutes, Value value) {
  Column column{std::move(name), role, {}};
  for (std::size_t i = 0; i <= minutes; ++i) column.values.push_back(value(static_cast<double>(i)));
  return column;
}

Series series_of(std::size_t minutes, std::vector<Column> columns) {
  Series series;
  for (std::size_t i = 0; i <= minutes; ++i) series.time_s.push_back(60.0 * static_cast<double>(i));
  series.columns = std::move(columns);
  return series;
}

ThermalTest test_of(const Series& series) {
  return thermal_test(std::span(&series, 1), series.time_s.front(), series.time_s.back());
}

TEST(ThermalTest, a_spindle_at_rest_is_etve_and_a_day_shows_the_room) {
  const Column rest = column_of("speed_rpm", Role::speed, 200, [](double) { return 0.0; });
  const Column room = column_of("T_room_degC", Role::ambient, 200, [](double t) { return 20.0 + 0.01 * t; });
  const ThermalTest test = test_of(series_of(200, {rest, room}));
  EXPECT_EQ(test.kind, ThermalTestKind::environment);
  EXPECT_EQ(test.lacks, std::vector{TestLack::a_day});
  ASSERT_EQ(test.temperatures.size(), 1U);
  EXPECT_DOUBLE_EQ(test.temperatures[0].least_degC, 20.0);
  EXPECT_DOUBLE_EQ(test.temperatures[0].largest_degC, 22.0);
  EXPECT_EQ(test_of(series_of(200, {rest})).lacks, (std::vector{TestLack::room_temperature, TestLack::a_day}));
}

TEST(ThermalTest, one_speed_with_a_ripple_and_its_rest) {
  const Column speed = column_of("speed_rpm", Role::speed, 300,
                                 [](double t) { return t < 5.0 || t >= 245.0 ? 0.0 : 3000.0 + 25.0 * std::sin(t); });
  const ThermalTest test = test_of(series_of(300, {speed}));
  EXPECT_EQ(test.kind, ThermalTestKind::spindle);
  EXPECT_DOUBLE_EQ(test.running_s, 4.0 * kHour_s);
  EXPECT_DOUBLE_EQ(test.rest_after_s, 55.0 * 60.0);
  ASSERT_EQ(test.speeds.size(), 1U);
  EXPECT_NEAR(test.speeds[0], 3000.0, 25.0);
  EXPECT_EQ(test.lacks, (std::vector{TestLack::room_temperature, TestLack::structure_temperature}));
}

TEST(ThermalTest, several_speeds_are_a_spectrum_and_its_end_lacks_the_rest) {
  const Column speed = column_of("speed_rpm", Role::speed, 240, [](double t) { return t < 120.0 ? 4000.0 : 8000.0; });
  const ThermalTest test = test_of(series_of(240, {speed}));
  EXPECT_EQ(test.kind, ThermalTestKind::spindle_spectrum);
  EXPECT_EQ(test.speeds, (std::vector{4000.0, 8000.0}));
  EXPECT_EQ(test.lacks.back(), TestLack::rest_after);
}

TEST(ThermalTest, a_feed_or_the_letter_of_an_axis_is_no_spindle) {
  const auto moving = [](double t) { return t < 180.0 ? 50.0 : 0.0; };
  EXPECT_EQ(test_of(series_of(240, {column_of("feed_mm_per_min", Role::structure, 240, moving)})).kind,
            ThermalTestKind::linear_axes);
  EXPECT_EQ(test_of(series_of(240, {column_of("C_deg_per_min", Role::structure, 240, moving)})).kind,
            ThermalTestKind::rotary_axes);
  Column speed = column_of("n_rpm", Role::speed, 240, moving);
  speed.header = "n C-axis [1/min]";
  EXPECT_EQ(test_of(series_of(240, {speed})).kind, ThermalTestKind::rotary_axes);
  EXPECT_EQ(test_of(series_of(240, {column_of("z_um", Role::measured, 240, moving)})).kind, ThermalTestKind::unknown);
  speed.header = "Spindle C1 [1/min]";
  EXPECT_EQ(test_of(series_of(240, {speed})).kind, ThermalTestKind::spindle);
}

// Only what is within the record and known counts.
TEST(ThermalTest, a_speed_that_is_not_known_is_none) {
  const double gap = std::nan("");
  const auto kind_of = [](const Series& series) { return test_of(series).kind; };
  EXPECT_EQ(kind_of(series_of(200, {column_of("n_rpm", Role::speed, 200, [&](double) { return gap; })})),
            ThermalTestKind::unknown);
  const Series ends =
      series_of(600, {column_of("n_rpm", Role::speed, 600, [&](double t) { return t > 60.0 ? gap : 3000.0; })});
  EXPECT_DOUBLE_EQ(test_of(ends).running_s, kHour_s);
  const Series one_row =
      series_of(600, {column_of("n_rpm", Role::speed, 600, [](double t) { return t == 30.0 ? 2.0 : 0.0; })});
  EXPECT_EQ(kind_of(one_row), ThermalTestKind::environment);
  const Series before =
      series_of(600, {column_of("n_rpm", Role::speed, 600, [](double t) { return t < 120.0 ? 8000.0 : 0.0; })});
  EXPECT_EQ(thermal_test(std::span(&before, 1), 130.0 * 60.0, 600.0 * 60.0).kind, ThermalTestKind::environment);
}

// Axes with stated sigmas keep their rows, the others have means of neighbours: the combined drift needs one choice.
TEST(ThermalTest, axes_with_and_without_noise_are_combined_row_by_row) {
  Series series = series_of(5000, {column_of("x_um", Role::measured, 5000, [](double t) { return 1e-3 * t; }),
                                   column_of("x_sigma_um", Role::measured, 5000, [](double) { return 0.1; }),
                                   column_of("y_um", Role::measured, 5000, [](double t) { return 2e-3 * t; })});
  const LargestDrift last = largest_drifts(since_reference(measured(series, "log"), std::nullopt)).back();
  EXPECT_NEAR(last.drift.value_um, std::hypot(5.0, 10.0), 0.01);
}

TEST(MeasuredDrift, readings_far_from_their_neighbours_are_set_aside_and_said) {
  Series series =
      series_of(100, {column_of("d_um", Role::measured, 100, [](double t) { return 0.1 * std::sin(7.0 * t * t); })});
  series.columns[0].values[40] = 50.0;
  const MeasuredDrift drift = since_reference(measured(series, "log"), std::nullopt);
  EXPECT_TRUE(std::isnan(drift.axes[0].value[40]));
  ASSERT_EQ(drift.remarks.size(), 1U);
  EXPECT_EQ(text_of(drift.remarks[0]), "Set aside, far from their neighbours: 1 reading of d, at 40 min.");
}

TEST(MeasuredDrift, an_axis_that_ends_before_the_reference_has_the_last_value_before_it) {
  const Series series = series_of(
      100, {column_of("x_um", Role::measured, 100, [](double t) { return t > 60.0 ? std::nan("") : 0.1 * t; }),
            column_of("y_um", Role::measured, 100, [](double t) { return 0.1 * t; })});
  const MeasuredDrift drift = since_reference(measured(series, "log"), 6000.0);
  EXPECT_DOUBLE_EQ(drift.axes[0].value[60], 0.0);
  EXPECT_DOUBLE_EQ(drift.axes[0].value[0], -6.0);
}

// The largest of noisy rows is too large by two or three sigma; that of the curve is not.
TEST(ThermalTest, the_largest_drift_is_that_of_the_curve) {
  double off = 0.0, off_combined = 0.0;
  constexpr int kSeeds = 40;
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> noise(0.0, 0.6);
    const auto axis = [&](const char* name, double end) {
      return column_of(name, Role::measured, 180,
                       [&, end](double t) { return end * (1.0 - std::exp(-t / 30.0)) + noise(random); });
    };
    const Series series = series_of(180, {axis("dX_um", 3.0), axis("dY_um", -4.0), axis("Probe_Z_um", 12.0)});
    const std::vector<LargestDrift> all = largest_drifts(since_reference(measured(series, "log"), std::nullopt));
    ASSERT_EQ(all.size(), 4U);
    EXPECT_EQ(all[3].axis, "combined");
    off += (std::abs(all[1].drift.value_um) - 4.0) / kSeeds;
    off_combined += (all[3].drift.value_um - 13.0) / kSeeds;
    EXPECT_LT(std::abs(all[2].drift.value_um - 12.0), 4.0 * all[2].drift.sigma_um + 0.1);
  }
  EXPECT_NEAR(off, 0.0, 0.15);
  EXPECT_NEAR(off_combined, 0.0, 0.15);
}

TEST(ThermalTest, two_axes_are_combined_under_their_names) {
  const auto rising = [](double t) { return 0.01 * t; };
  const Series series =
      series_of(20, {column_of("x_um", Role::measured, 20, rising), column_of("y_um", Role::measured, 20, rising)});
  EXPECT_EQ(largest_drifts(measured(series, "log")).back().axis, "combined x, y");
}

TEST(MeasuredDrift, a_position_and_a_constant_are_left_out_and_said) {
  const Series series = series_of(60, {column_of("z_mm", Role::measured, 60, [](double t) { return 1e-4 * t; }),
                                       column_of("position_mm", Role::measured, 60, [](double t) { return 10.0 * t; }),
                                       column_of("limit_um", Role::measured, 60, [](double) { return 5.0; })});
  const MeasuredDrift drift = since_reference(measured(series, "log"), 600.0);
  ASSERT_EQ(drift.axes.size(), 1U);
  EXPECT_EQ(drift.axes[0].unit, "um");
  EXPECT_NEAR(drift.axes[0].value[60], 5.0, 1e-9);
  EXPECT_DOUBLE_EQ(drift.axes[0].value[10], 0.0);
  EXPECT_EQ(drift.remarks.size(), 2U);
}

TEST(MeasuredDrift, readings_at_two_positions_in_turn_are_two_axes_and_a_length) {
  const auto position = [](double t) { return std::fmod(t, 2.0) == 0.0 ? 0.0 : 800.0; };
  const Series series = series_of(120, {column_of("position_mm", Role::structure, 120, position),
                                        column_of("error_um", Role::measured, 120, [&](double t) {
                                          return position(t) > 0.0 ? 20.0 + 0.2 * t : 0.02 * t;
                                        })});
  const MeasuredDrift drift =
      with_lengths(since_reference(at_each_position(measured(series, "log"), series), std::nullopt));
  ASSERT_EQ(drift.axes.size(), 3U);
  EXPECT_EQ(drift.axes[0].name, "error at 0 mm");
  EXPECT_EQ(drift.axes[1].name, "error at 800 mm");
  EXPECT_NEAR(drift.axes[1].value[119], 0.2 * 118.0, 1e-9);
  EXPECT_NEAR(drift.axes[2].value[120], 0.2 * 118.0 - 0.02 * 120.0, 1e-9);
}

// Readings of fixed places are theirs, wherever the axis stands when they are taken.
TEST(MeasuredDrift, readings_that_do_not_depend_on_the_position_stay_whole) {
  const Series series = series_of(
      120, {column_of("position_mm", Role::structure, 120, [](double t) { return std::fmod(t, 2.0) * 100.0; }),
            column_of("error_um", Role::measured, 120, [](double t) { return 0.1 * t; })});
  EXPECT_EQ(at_each_position(measured(series, "log"), series).axes.size(), 1U);
}

}  // namespace
}  // namespace ballbar
