#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "ballbar/drift/drift.hpp"
#include "ballbar/error.hpp"
namespace ballbar {
namespace {

constexpr double kGap = std::numeric_limits<double>::quiet_NaN();
constexpr double kRounding = 1e-12;  // um: a few operations on numbers of order 1

using Texts = std::vector<std::string>;

// A session of three tests, as far as a budget looks at it: bar of 100 mm, 20, 23 and 18 degC.
Session session(Method method) {
  Session session;
  session.method = method;
  session.nominal_length_mm = 100.0;
  session.bar_expansion_ppm_per_K = 12.0;
  for (const double bar_degC : {20.0, 23.0, 18.0}) {
    SessionTest test;
    test.elapsed_s = 600.0 * static_cast<double>(session.tests.size());
    test.rotation = Recording{};
    test.rotation->bar_temperature_degC = bar_degC;
    session.tests.push_back(test);
  }
  return session;
}

DriftSeries rotation_series() {
  DriftSeries drift;
  drift.method = Method::spindle_rotation;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto n = static_cast<double>(i);
    DriftPoint point;
    point.time_s = 600.0 * n;
    point.radial = Estimate{2.0 * n, 0.1 * n};
    point.axial = Estimate{5.0 * n, 0.2 * n};
    drift.points.push_back(point);
  }
  return drift;
}

const Contribution* contribution(const MeasuredDrift& drift, std::string_view axis, std::string_view source) {
  for (const Contribution& one : find_axis(drift, axis)->budget) {
    if (one.source == source) return &one;
  }
  return nullptr;
}

TEST(measured_drift, sigma_is_the_root_of_the_sum_of_squares_of_what_is_known) {
  const DriftAxis axis{"x", "um", {0.0, 1.0, 2.0}, {{"a", {0.0, 3.0, kGap}}, {"b", {kGap, 4.0, kGap}}}};
  EXPECT_EQ(sigma_of(axis, 0), 0.0);
  EXPECT_NEAR(sigma_of(axis, 1), 5.0, kRounding);
  EXPECT_TRUE(std::isnan(sigma_of(axis, 2)));
  EXPECT_TRUE(std::isnan(sigma_of({"x", "um", {0.0}, {}}, 0))) << "nothing stated";
}

TEST(measured_drift, axis_by_name) {
  MeasuredDrift drift;
  drift.axes = {{"x", "um", {}, {}}, {"tilt_a", "urad", {}, {}}};
  EXPECT_EQ(find_axis(drift, "tilt_a"), &drift.axes[1]);
  EXPECT_EQ(find_axis(drift, "tilt"), nullptr);
}

// alpha L |dT| / sqrt(3) = 12e-6 / K * 100 mm = 1.2 um / K: 3.6 / sqrt(3) um at +3 K, 2.4 / sqrt(3) um at -2 K.
TEST(measured_drift, growth_of_the_bar_is_in_the_axial_drift) {
  const MeasuredDrift drift = measured(rotation_series(), session(Method::spindle_rotation));
  EXPECT_EQ(drift.what, "ballbar, spindle_rotation");
  EXPECT_EQ(drift.reference_s, 0.0);
  EXPECT_EQ(drift.time_s, (std::vector<double>{0.0, 600.0, 1200.0}));
  EXPECT_TRUE(drift.remarks.empty());
  ASSERT_EQ(drift.axes.size(), 2U);
  EXPECT_EQ(drift.axes[0].name, "radial");
  EXPECT_EQ(drift.axes[0].unit, "um");
  EXPECT_EQ(drift.axes[0].value, (std::vector<double>{0.0, 2.0, 4.0}));
  EXPECT_EQ(drift.axes[1].name, "axial");
  EXPECT_EQ(contribution(drift, "axial", "circle fits")->sigma, (std::vector<double>{0.0, 0.2, 0.4}));
  const std::vector<double>& growth_um = contribution(drift, "axial", "bar's thermal growth")->sigma;
  EXPECT_EQ(growth_um[0], 0.0);
  EXPECT_NEAR(growth_um[1], 3.6 / std::sqrt(3.0), kRounding);
  EXPECT_NEAR(growth_um[2], 2.4 / std::sqrt(3.0), kRounding);
  EXPECT_NEAR(sigma_of(drift.axes[1], 1), std::sqrt(0.04 + 12.96 / 3.0), kRounding);
  EXPECT_EQ(contribution(drift, "radial", "bar's thermal growth")->sigma, (std::vector<double>{0.0, 0.0, 0.0}));
  EXPECT_NEAR(sigma_of(drift.axes[0], 2), 0.2, kRounding);
}

// Reference at 600 s, 23 degC: 3 K before, 5 K after.
TEST(measured_drift, growth_counts_from_the_reference) {
  DriftSeries series = rotation_series();
  series.reference_s = 600.0;
  const MeasuredDrift drift = measured(series, session(Method::spindle_rotation));
  const std::vector<double>& growth_um = contribution(drift, "axial", "bar's thermal growth")->sigma;
  EXPECT_NEAR(growth_um[0], 3.6 / std::sqrt(3.0), kRounding);
  EXPECT_EQ(growth_um[1], 0.0);
  EXPECT_NEAR(growth_um[2], 6.0 / std::sqrt(3.0), kRounding);
}

TEST(measured_drift, temperature_of_the_axial_recording_comes_first) {
  Session one = session(Method::spindle_rotation);
  one.tests[1].axial = Recording{};
  one.tests[1].axial->bar_temperature_degC = 21.0;
  const MeasuredDrift drift = measured(rotation_series(), one);
  EXPECT_NEAR(contribution(drift, "axial", "bar's thermal growth")->sigma[1], 1.2 / std::sqrt(3.0), kRounding);
}

TEST(measured_drift, growth_that_is_not_stated_is_said) {
  Session silent = session(Method::spindle_rotation);
  silent.bar_expansion_ppm_per_K.reset();
  MeasuredDrift drift = measured(rotation_series(), silent);
  EXPECT_EQ(texts_of(drift.remarks),
            Texts{"The bar's thermal growth is not in the uncertainty: the session does not state its "
                  "expansion (expansion_ppm_per_K under [bar])."});
  EXPECT_EQ(contribution(drift, "axial", "bar's thermal growth"), nullptr);
  EXPECT_EQ(contribution(drift, "radial", "bar's thermal growth"), nullptr);

  const Texts no_temperature = {
      "The bar's thermal growth is not in the uncertainty: not every test states the bar's temperature "
      "(bar_temperature_degC)."};
  for (const std::size_t test : {0U, 2U}) {
    Session cold = session(Method::spindle_rotation);
    cold.tests[test].rotation->bar_temperature_degC.reset();
    drift = measured(rotation_series(), cold);
    EXPECT_EQ(texts_of(drift.remarks), no_temperature) << "test " << test;
    EXPECT_EQ(contribution(drift, "axial", "bar's thermal growth"), nullptr);
  }
}

// x, y and z do not need the bar's temperature: the bar's growth changes the radius, not the centre.
TEST(measured_drift, growth_moves_no_centre) {
  Session arcs = session(Method::two_arcs);
  DriftSeries series;
  series.method = Method::two_arcs;
  for (const double time_s : {0.0, 600.0, 1200.0}) {
    DriftPoint point;
    point.time_s = time_s;
    point.x = Estimate{time_s / 600.0, time_s / 6000.0};
    point.z = time_s == 600.0 ? std::nullopt : std::optional(Estimate{1.0, 0.5});
    series.points.push_back(point);
  }
  for (SessionTest& test : arcs.tests) test.rotation.reset();
  const MeasuredDrift drift = measured(series, arcs);
  EXPECT_EQ(drift.what, "ballbar, two_arcs");
  EXPECT_TRUE(drift.remarks.empty());
  ASSERT_EQ(drift.axes.size(), 2U) << "y is never there";
  EXPECT_EQ(contribution(drift, "x", "bar's thermal growth")->sigma, (std::vector<double>{0.0, 0.0, 0.0}));
  EXPECT_NEAR(sigma_of(drift.axes[0], 2), 0.2, kRounding);
  EXPECT_TRUE(std::isnan(find_axis(drift, "z")->value[1])) << "a test without it is a gap";
}

// A length read off a display has no sigma; what is left is the bar's growth.
TEST(measured_drift, no_sigma_no_circle_fits) {
  DriftSeries series = rotation_series();
  for (std::size_t i = 1; i < 3; ++i) series.points[i].axial->sigma_um = kGap;
  const MeasuredDrift drift = measured(series, session(Method::spindle_rotation));
  EXPECT_EQ(contribution(drift, "axial", "circle fits"), nullptr);
  EXPECT_NE(contribution(drift, "radial", "circle fits"), nullptr);
}

TEST(measured_drift, columns_of_a_series) {
  Series series;
  series.time_s = {60.0, 120.0};
  series.columns = {{"x_um", Role::measured, {0.0, 1.0}},         {"x_sigma_um", Role::measured, {0.0, 0.3}},
                    {"tilt_a_urad", Role::measured, {0.0, kGap}}, {"gap_mm", Role::measured, {0.0, 0.5}},
                    {"T_air_degC", Role::ambient, {20.0, 21.0}},  {"depth_um", Role::event, {1.0, 1.0}}};
  const MeasuredDrift drift = measured(series, "probes.csv");
  EXPECT_EQ(drift.what, "probes.csv");
  EXPECT_EQ(drift.reference_s, 60.0);
  ASSERT_EQ(drift.axes.size(), 3U);
  EXPECT_EQ(drift.axes[0].name, "x");
  EXPECT_EQ(drift.axes[0].unit, "um");
  EXPECT_EQ(drift.axes[0].value, (std::vector<double>{0.0, 1.0}));
  EXPECT_EQ(contribution(drift, "x", "sigma of probes.csv")->sigma, (std::vector<double>{0.0, 0.3}));
  EXPECT_EQ(drift.axes[1].name, "tilt_a");
  EXPECT_EQ(drift.axes[1].unit, "urad");
  EXPECT_TRUE(drift.axes[1].budget.empty());
  EXPECT_EQ(drift.axes[2].name, "gap");
  EXPECT_EQ(drift.axes[2].unit, "mm");
}

TEST(measured_drift, to_a_series_and_back) {
  MeasuredDrift drift;
  drift.time_s = {0.0, 600.0, 1200.0};
  drift.axes = {{"x", "um", {0.0, 1.0, kGap}, {{"circle fits", {0.0, 0.3, 0.3}}, {"growth", {0.0, 0.4, kGap}}}},
                {"tilt_b", "urad", {0.0, -5.0, 7.0}, {}}};
  const Series series = series_of(drift);
  ASSERT_EQ(series.columns.size(), 3U);
  EXPECT_EQ(series.columns[0].name, "x_um");
  EXPECT_EQ(series.columns[1].name, "x_sigma_um");
  EXPECT_EQ(series.columns[2].name, "tilt_b_urad") << "no sigma is stated, none is written";
  for (const Column& column : series.columns) EXPECT_EQ(column.role, Role::measured) << column.name;

  const MeasuredDrift back = measured(series, "again");
  EXPECT_EQ(back.time_s, drift.time_s);
  ASSERT_EQ(back.axes.size(), 2U);
  for (std::size_t i = 0; i < back.axes.size(); ++i) {
    EXPECT_EQ(back.axes[i].name, drift.axes[i].name);
    EXPECT_EQ(back.axes[i].unit, drift.axes[i].unit);
    for (std::size_t row = 0; row < 3; ++row) {
      const double value = back.axes[i].value[row], was = drift.axes[i].value[row];
      EXPECT_TRUE(value == was || (std::isnan(value) && std::isnan(was))) << i << ", row " << row;
    }
  }
  EXPECT_NEAR(sigma_of(back.axes[0], 1), 0.5, kRounding);
  EXPECT_NEAR(sigma_of(back.axes[0], 2), 0.3, kRounding);
}

TEST(measured_drift, a_sigma_never_known_is_not_written) {
  MeasuredDrift drift;
  drift.time_s = {0.0, 600.0};
  drift.axes = {{"x", "um", {0.0, 1.0}, {{"circle fits", {kGap, kGap}}}}};
  ASSERT_EQ(series_of(drift).columns.size(), 1U);
  EXPECT_EQ(series_of(drift).columns[0].name, "x_um");
}

TEST(measured_drift, a_series_without_rows) {
  try {
    measured(Series{}, "probes.csv");
    ADD_FAILURE() << "no Error";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "expected rows, found none in probes.csv.");
  }
}

}  // namespace
}  // namespace ballbar
