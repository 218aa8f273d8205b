#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "../made_series.hpp"
#include "ballbar/drift/compare.hpp"
#include "numerics/random_streams.hpp"

namespace ballbar {
namespace {

constexpr double kGap = std::numeric_limits<double>::quiet_NaN();
constexpr double kRounding = 1e-12;  // a few operations on numbers of order 10

std::vector<double> minutes(const std::vector<double>& time_min) {
  std::vector<double> time_s;
  for (const double one_min : time_min) time_s.push_back(60.0 * one_min);
  return time_s;
}

// One axis with the same sigma in every row but the first, the reference; sigma 0: none is stated.
MeasuredDrift drift(std::string what, std::vector<double> time_s, std::vector<double> value, double sigma,
                    std::string name = "x", std::string unit = "um") {
  MeasuredDrift one;
  one.what = std::move(what);
  one.time_s = std::move(time_s);
  DriftAxis axis{std::move(name), std::move(unit), std::move(value), {}};
  if (sigma > 0.0) {
    axis.budget.push_back({"sigma of " + one.what, std::vector<double>(one.time_s.size(), sigma)});
    axis.budget.back().sigma.front() = 0.0;
  }
  one.axes.push_back(std::move(axis));
  return one;
}

MeasuredDrift with(MeasuredDrift one, const MeasuredDrift& other) {
  one.axes.insert(one.axes.end(), other.axes.begin(), other.axes.end());
  return one;
}

const AxisComparison& axis_of(const Comparison& comparison, std::string_view name = "x") {
  for (const AxisComparison& axis : comparison.axes) {
    if (axis.name == name) return axis;
  }
  throw std::out_of_range(std::string(name));
}

using Values = std::vector<double>;
using Texts = std::vector<std::string>;

// d is the difference since the first of so many rows a minute apart; b does not move.
AxisComparison compared(const Values& d, double sigma) {
  Values time_s;
  for (std::size_t i = 0; i < d.size(); ++i) time_s.push_back(60.0 * static_cast<double>(i));
  return axis_of(compare(drift("a", time_s, d, sigma), drift("b", time_s, Values(d.size(), 0.0), 0.0)));
}

// b 0 1 10 20 and a 0 3 9 24: d = 2 -1 4 after the reference.
//   range of b 20, a tenth 2: |b| = 1 is left out; mean relative (1/10 + 4/20) / 2 = 0.15
//   of the range (2 + 1 + 4) / 3 / 20; rmse sqrt((4 + 1 + 16) / 3) = sqrt 7; largest 4 at 30 min
//   bias 5/3; squares of d - bias: (1 + 64 + 49) / 9 = 114/9, sd sqrt(19/3)
//   sigma 0.3 and 0.4: 0.5; beyond 1: 2 and 4, so 1 of 3 within (|d| = 2 sigma counts as within)
//   expected sqrt(2/pi) 0.5 (1/10 + 1/20) / 2 = sqrt(2/pi) 0.0375; explained: of 0.15 a quarter of sqrt(2/pi)
//   correlation: a - 9 = -9 -6 0 15, b - 7.75 = -7.75 -6.75 2.25 12.25: products 294, squares 342 and 260.75
TEST(comparison, statistics_by_hand) {
  const Values time_s = minutes({0, 10, 20, 30});
  const Comparison all =
      compare(drift("ballbar", time_s, {0, 3, 9, 24}, 0.3), drift("probes", time_s, {0, 1, 10, 20}, 0.4));
  EXPECT_EQ(all.a, "ballbar");
  EXPECT_EQ(all.b, "probes");
  EXPECT_EQ(all.samples, 4U);
  EXPECT_EQ(all.left_out, 0U);
  EXPECT_EQ(all.reference_s, 0.0);
  const AxisComparison& x = axis_of(all);
  EXPECT_EQ(x.unit, "um");
  EXPECT_EQ(x.difference, (Values{0, 2, -1, 4}));
  EXPECT_NEAR(x.mean_relative_deviation.value(), 0.15, kRounding);
  EXPECT_NEAR(x.range_deviation.value(), 7.0 / 60.0, kRounding);
  EXPECT_NEAR(x.rmse, std::sqrt(7.0), kRounding);
  EXPECT_EQ(x.largest, 4.0);
  EXPECT_EQ(x.largest_s, 1800.0);
  EXPECT_NEAR(x.bias, 5.0 / 3.0, kRounding);
  EXPECT_NEAR(x.limit_low.value(), 5.0 / 3.0 - 1.96 * std::sqrt(19.0 / 3.0), kRounding);
  EXPECT_NEAR(x.limit_high.value(), 5.0 / 3.0 + 1.96 * std::sqrt(19.0 / 3.0), kRounding);
  EXPECT_EQ(x.sigma[0], 0.0);
  EXPECT_NEAR(x.sigma[3], 0.5, kRounding);
  EXPECT_EQ(x.counted, 3U);
  EXPECT_EQ(x.within, 1U);
  EXPECT_NEAR(x.expected_relative_deviation.value(), std::sqrt(2.0 / std::numbers::pi) * 0.0375, kRounding);
  EXPECT_NEAR(x.explained_share.value(), std::sqrt(2.0 / std::numbers::pi) * 0.25, kRounding);
  EXPECT_NEAR(x.correlation.value(), 294.0 / std::sqrt(342.0 * 260.75), kRounding);
  ASSERT_EQ(x.budget.size(), 2U);
  EXPECT_EQ(x.budget[0].source, "sigma of ballbar");
  EXPECT_NEAR(x.budget[0].sigma, 0.3, kRounding) << "the reference is left out";
  EXPECT_NEAR(x.budget[0].variance, 0.36, kRounding);
  EXPECT_NEAR(x.budget[1].variance, 0.64, kRounding);
}

TEST(comparison, what_is_not_defined_is_left_out) {
  const AxisComparison still = compared({0, 1, 2, 3}, 0.5);
  EXPECT_FALSE(still.mean_relative_deviation.has_value()) << "b does not move";
  EXPECT_FALSE(still.expected_relative_deviation.has_value());
  EXPECT_FALSE(still.explained_share.has_value());
  EXPECT_FALSE(still.range_deviation.has_value());
  EXPECT_FALSE(still.correlation.has_value());
  const Values time_s = minutes({0, 10, 20});
  const AxisComparison same = axis_of(compare(drift("a", time_s, {0, 1, 2}, 0.1), drift("b", time_s, {0, 1, 2}, 0.1)));
  EXPECT_EQ(same.mean_relative_deviation, 0.0);
  EXPECT_FALSE(same.explained_share.has_value()) << "nothing to explain";
  EXPECT_NEAR(same.correlation.value(), 1.0, kRounding);
  const AxisComparison noisy =
      axis_of(compare(drift("a", time_s, {0, 1.001, 2}, 1.0), drift("b", time_s, {0, 1, 2}, 1.0)));
  EXPECT_EQ(noisy.explained_share, 1.0) << "at most all of it";
}

// b at 0 20 40 min is 0 4 2; a at 10 30 and 50 min lies between, 50 min beyond. From the first common time:
// b(10) = 2, b(20) = 4 and b(30) = 3 less 2; a 1 5 6 7 less 1.
TEST(comparison, interpolates_and_does_not_extrapolate) {
  const MeasuredDrift a = drift("a", minutes({10, 20, 30, 50}), {1, 5, 6, 7}, 0.0);
  const MeasuredDrift b = drift("b", minutes({0, 20, 40, 45, 47}), {0, 4, 2, 0, 0}, 0.0);
  const Comparison all = compare(a, b);
  EXPECT_EQ(all.samples, 3U);
  EXPECT_EQ(all.reference_s, 600.0);
  const AxisComparison& x = axis_of(all);
  EXPECT_EQ(x.time_s, minutes({10, 20, 30}));
  EXPECT_EQ(x.a, (Values{0, 4, 5}));
  EXPECT_EQ(x.b, (Values{0, 2, 1}));
}

// The series with fewer rows gives the times, whichever it is; d stays a - b.
TEST(comparison, sparse_and_dense_either_way_round) {
  const MeasuredDrift sparse = drift("sparse", minutes({0, 10, 20, 30}), {0, 3, 4, 9}, 0.3);
  const MeasuredDrift dense = drift("dense", minutes({0, 5, 10, 15, 20, 25, 30}), {0, 1, 2, 3, 4, 5, 6}, 0.4);
  const AxisComparison forward = axis_of(compare(sparse, dense)), backward = axis_of(compare(dense, sparse));
  EXPECT_EQ(forward.time_s, sparse.time_s);
  EXPECT_EQ(backward.time_s, sparse.time_s);
  EXPECT_EQ(forward.difference, (Values{0, 1, 0, 3}));
  EXPECT_EQ(backward.difference, (Values{0, -1, 0, -3}));
  EXPECT_EQ(forward.a, backward.b);
  EXPECT_EQ(forward.sigma, backward.sigma);
  EXPECT_EQ(forward.agreement, backward.agreement);
}

// Rows in the common time decide which series is the sparse one, not rows in all.
TEST(comparison, only_rows_in_the_common_time_count) {
  const MeasuredDrift longer =
      drift("long", minutes({-50, -40, -30, -20, -10, 0, 10, 20}), {1, 1, 1, 1, 1, 0, 2, 4}, 0.0);
  const MeasuredDrift dense = drift("dense", minutes({0, 5, 10, 15, 20}), {0, 1, 2, 3, 4}, 0.0);
  EXPECT_EQ(axis_of(compare(longer, dense)).time_s, minutes({0, 10, 20}));
}

// Steps of b: 5 5 25 5 5 min, median 5: a gap is longer than 20 min. a at 12 and 20 min falls into it, 35 min does not:
// that is a row of b.
TEST(comparison, never_across_a_gap) {
  const MeasuredDrift a = drift("a", minutes({0, 12, 20, 35, 42, 45}), {0, 1, 2, 3, 4, 5}, 0.0);
  const MeasuredDrift b = drift("b", minutes({0, 5, 10, 35, 40, 45, 46}), {0, 1, 2, 3, 4, 5, 6}, 0.0);
  Comparison all = compare(a, b);
  EXPECT_EQ(all.samples, 4U);
  EXPECT_EQ(all.left_out, 2U);
  EXPECT_EQ(axis_of(all).time_s, minutes({0, 35, 42, 45}));
  ComparisonOptions options;
  options.max_gap_s = 25.0 * 60.0;
  all = compare(a, b, options);
  EXPECT_EQ(all.samples, 6U);
  EXPECT_EQ(all.left_out, 0U);
  options.max_gap_s = 60.0;
  EXPECT_EQ(axis_of(compare(a, b, options)).time_s, minutes({0, 35, 45})) << "rows of b alone";
}

// Zero at 20 min (nearest to 22): 3 and 4 are taken off, and the sigma of that row is added to all others: the first
// row, 0 by definition before, has it now: hypot(0.3, 0.4); the others hypot(0.3, 0.3, 0.4, 0.4).
TEST(comparison, the_zero_may_be_moved) {
  const Values time_s = minutes({0, 10, 20, 30});
  ComparisonOptions options;
  options.reference_s = 22.0 * 60.0;
  const Comparison all = compare(drift("a", time_s, {0, 1, 3, 5}, 0.3), drift("b", time_s, {0, 2, 4, 5}, 0.4), options);
  EXPECT_EQ(all.reference_s, 1200.0);
  const AxisComparison& x = axis_of(all);
  EXPECT_EQ(x.a, (Values{-3, -2, 0, 2}));
  EXPECT_EQ(x.b, (Values{-4, -2, 0, 1}));
  EXPECT_EQ(x.difference, (Values{1, 0, 0, 1}));
  EXPECT_NEAR(x.sigma[0], 0.5, kRounding);
  EXPECT_NEAR(x.sigma[1], std::sqrt(0.5), kRounding);
  EXPECT_EQ(x.sigma[2], 0.0);
  EXPECT_EQ(x.counted, 3U);
  EXPECT_EQ(x.within, 3U) << "1 is 2 sigma of the first";
}

// Different zeros of the two are no disagreement: the second begins 10 min after the first, 7 um further on.
TEST(comparison, series_with_different_zeros) {
  const MeasuredDrift a = drift("a", minutes({0, 10, 20, 30}), {0, 7, 8, 9}, 0.1);
  const MeasuredDrift b = drift("b", minutes({10, 20, 30}), {0, 1, 2}, 0.1);
  const AxisComparison x = axis_of(compare(a, b));
  EXPECT_EQ(x.difference, (Values{0, 0, 0}));
  EXPECT_EQ(x.agreement, Agreement::agrees);
}

TEST(comparison, an_axis_with_gaps) {
  const Values time_s = minutes({0, 10, 20, 30, 40});
  const MeasuredDrift a =
      with(drift("a", time_s, {0, 1, 2, 3, 4}, 0.1), drift("a", time_s, {kGap, 1, 2, kGap, 4}, 0.1, "y"));
  const MeasuredDrift b =
      with(drift("b", time_s, {0, 1, kGap, 3, 4}, 0.1), drift("b", time_s, {0, 1, 2, 3, 4}, 0.1, "y"));
  const Comparison all = compare(a, b);
  EXPECT_EQ(all.samples, 5U);
  EXPECT_EQ(axis_of(all, "x").time_s, minutes({0, 10, 30, 40}));
  EXPECT_EQ(axis_of(all, "y").time_s, minutes({10, 20, 40}));
  EXPECT_EQ(axis_of(all, "y").a, (Values{0, 1, 3})) << "from its own first sample";
}

TEST(comparison, an_axis_of_too_few_samples_is_said) {
  const Values time_s = minutes({0, 10, 20, 30});
  MeasuredDrift a = with(drift("a", time_s, {0, 1, 2, 3}, 0.1), drift("a", time_s, {0, kGap, 2, kGap}, 0.1, "y"));
  a.remarks = {as_it_is("Of a.")};
  MeasuredDrift b = with(drift("b", time_s, {0, 1, 2, 3}, 0.1), drift("b", time_s, {0, 1, 2, 3}, 0.1, "y"));
  b.remarks = {as_it_is("Of b.")};
  const Comparison all = compare(a, b);
  ASSERT_EQ(all.axes.size(), 1U);
  EXPECT_EQ(texts_of(all.remarks),
            (Texts{"Of a.", "Of b.", "y is not compared: both have a value at 2 of the common times, 3 are needed."}));
}

TEST(comparison, axes_that_only_one_has_are_left_out) {
  const Values time_s = minutes({0, 10, 20});
  const MeasuredDrift a = with(drift("a", time_s, {0, 1, 2}, 0.1), drift("a", time_s, {0, 1, 2}, 0.1, "z"));
  const MeasuredDrift b =
      with(drift("b", time_s, {0, 1, 2}, 0.1, "tilt_a", "urad"), drift("b", time_s, {0, 1, 2}, 0.1));
  const Comparison all = compare(a, b);
  ASSERT_EQ(all.axes.size(), 1U);
  EXPECT_EQ(all.axes[0].name, "x");
}

// The same source on both sides stands twice in the budget, told apart by its side.
TEST(comparison, twin_sources_are_told_apart) {
  const Values time_s = minutes({0, 10, 20});
  MeasuredDrift a = drift("morning", time_s, {0, 1, 2}, 0.3), b = drift("evening", time_s, {0, 1, 2}, 0.4);
  a.axes[0].budget[0].source = b.axes[0].budget[0].source = "probe scatter";
  const AxisComparison x = axis_of(compare(a, b));
  ASSERT_EQ(x.budget.size(), 2U);
  EXPECT_EQ(x.budget[0].source, "probe scatter, morning");
  EXPECT_EQ(x.budget[1].source, "probe scatter, evening");
}

// A series against itself: sigma 0.3 on both sides, half of the variance each.
TEST(comparison, twin_sources_of_twin_series_are_told_apart) {
  const MeasuredDrift one = drift("one.csv", minutes({0, 10, 20}), {0, 1, 2}, 0.3);
  const AxisComparison x = axis_of(compare(one, one));
  ASSERT_EQ(x.budget.size(), 2U);
  EXPECT_EQ(x.budget[0].source, "sigma of one.csv, the first");
  EXPECT_EQ(x.budget[1].source, "sigma of one.csv, the second");
  EXPECT_NEAR(x.budget[1].variance, 0.5, kRounding);
}

// Sigma between two rows of the dense series is on the straight line: 0 at its reference, 0.4 at 10 min, 0.2 between.
TEST(comparison, sigma_between_rows) {
  const MeasuredDrift a = drift("a", minutes({0, 5, 20}), {0, 1, 2}, 0.0);
  const MeasuredDrift b = drift("b", minutes({0, 10, 15, 20}), {0, 1, 2, 3}, 0.4);
  const AxisComparison x = axis_of(compare(a, b));
  EXPECT_NEAR(x.sigma[1], 0.2, kRounding);
  EXPECT_NEAR(x.sigma[2], 0.4, kRounding);
}

// A drift of 100 min with a bend, seen by two clocks: where a shows at t what b showed at t - lag, a is late.
double bent(double time_min) { return 20.0 * (1.0 - std::exp(-time_min / 30.0)) + 3.0 * std::sin(time_min / 10.0); }

MeasuredDrift seen(std::string what, double late_min, double step_min, double sigma) {
  Values time_min, value;
  for (double now_min = 0.0; now_min <= 100.0; now_min += step_min) {
    time_min.push_back(now_min);
    value.push_back(bent(now_min - late_min) + 5.0);
  }
  return drift(std::move(what), minutes(time_min), value, sigma);
}

// Straight lines between rows a minute apart are off by at most f'' h^2 / 8 = 0.007 um on slopes of 0.3 um/min: 1.5 s.
TEST(comparison, lag_with_its_sign_either_way_round) {
  for (const double late_min : {3.0, -4.5, 0.0}) {
    const AxisComparison sparse = axis_of(compare(seen("a", late_min, 2.0, 0.05), seen("b", 0.0, 1.0, 0.05)));
    EXPECT_NEAR(sparse.lag_s.value(), 60.0 * late_min, 1.5) << "a is sparse";
    const AxisComparison dense = axis_of(compare(seen("a", late_min, 1.0, 0.05), seen("b", 0.0, 2.0, 0.05)));
    EXPECT_NEAR(dense.lag_s.value(), 60.0 * late_min, 1.5) << "a is dense";
    EXPECT_GT(sparse.lag_sigma_s.value(), 0.5) << "0.07 um on 50 samples of about 0.4 um/min: 1.5 s";
    EXPECT_LT(sparse.lag_sigma_s.value(), 4.0);
  }
}

// 200 series with 0.2 um of noise on a: the lag found lies within 2 of its sigma in about 95 % of them; the standard
// deviation of that share is 1.5 %, so 90 to 99 % is three of them.
TEST(comparison, sigma_of_the_lag_is_its_scatter) {
  std::mt19937_64 random = simulation::stream_of(1, simulation::Stream::probe, simulation::key_of("sigma_of_the_lag"));
  int within = 0;
  for (int draw = 0; draw < 200; ++draw) {
    MeasuredDrift a = seen("a", 3.0, 2.0, 0.2);
    for (double& value : a.axes[0].value) value += 0.2 * simulation::normal(random);
    const AxisComparison x = axis_of(compare(a, seen("b", 0.0, 1.0, 0.0)));
    ASSERT_TRUE(x.lag_s.has_value());
    within += std::abs(*x.lag_s - 180.0) <= 2.0 * *x.lag_sigma_s ? 1 : 0;
  }
  EXPECT_GE(within, 180);
  EXPECT_LE(within, 198);
}

TEST(comparison, no_lag_where_none_is_determined) {
  Values time_min, zero, line;
  for (int i = 0; i <= 60; ++i) {
    time_min.push_back(i);
    zero.push_back(0.0);
    line.push_back(0.1 * i);
  }
  const Values time_s = minutes(time_min);
  EXPECT_FALSE(axis_of(compare(drift("a", time_s, zero, 0.1), drift("b", time_s, zero, 0.1))).lag_s) << "no drift";
  EXPECT_FALSE(axis_of(compare(drift("a", time_s, line, 0.1), drift("b", time_s, line, 0.1))).lag_s)
      << "a shift of a straight line is a constant";
  EXPECT_FALSE(axis_of(compare(seen("a", 45.0, 2.0, 0.1), seen("b", 0.0, 1.0, 0.1))).lag_s) << "beyond a quarter";
  const Values few = minutes({0, 10, 20});
  EXPECT_FALSE(axis_of(compare(drift("a", few, {0, 5, 2}, 0.1), drift("b", few, {0, 5, 2}, 0.1))).lag_s) << "3 samples";
}

// Scatter on a straight line, or on nothing, always has some shift that fits best; it says nothing about the clocks.
TEST(comparison, no_lag_from_scatter) {
  std::mt19937_64 random =
      simulation::stream_of(1, simulation::Stream::probe, simulation::key_of("no_lag_from_scatter"));
  for (const double um_per_min : {0.0, 0.137, -2.0}) {
    for (const double noise_um : {0.0, 0.1}) {
      for (int draw = 0; draw < 50; ++draw) {
        Values time_min, a, b;
        for (int i = 0; i <= 60; ++i) {
          time_min.push_back(i + 0.3 * simulation::uniform(random));
          a.push_back(um_per_min * time_min.back() + noise_um * simulation::normal(random));
          b.push_back(um_per_min * time_min.back() + noise_um * simulation::normal(random));
        }
        const AxisComparison x =
            axis_of(compare(drift("a", minutes(time_min), a, 0.1), drift("b", minutes(time_min), b, 0.1)));
        EXPECT_FALSE(x.lag_s.has_value()) << um_per_min << " um/min, " << noise_um << " um";
      }
    }
  }
}

// Half of the variance in common: of 3 samples at least 2 lie beyond 2 sigma with 1.9 %, all 3 with 0.28 %, of 1000 at
// least 402 with 1.0 % (integrated with scipy). The largest of 3 lies beyond z with 1 - (1 - erfc(z / sqrt 2))^3: 1 %
// at z = 2.935.
TEST(comparison, verdict_by_chance) {
  EXPECT_EQ(compared({0, 2.0, -2.0, 2.0}, 1.0).agreement, Agreement::agrees) << "2 sigma is within";
  EXPECT_FALSE(compared({0, 2.0, -2.0, 2.0}, 1.0).deviation.has_value());
  EXPECT_EQ(compared({0, 2.1, 0.0, 0.0}, 1.0).agreement, Agreement::agrees) << "1 of 3";
  EXPECT_TRUE(compared({0, 2.1, 0.0, 0.0}, 1.0).deviation.has_value()) << "said, though by chance";
  EXPECT_EQ(compared({0, 2.1, 0.0, -2.1}, 1.0).agreement, Agreement::agrees) << "2 of 3";
  EXPECT_EQ(compared({0, 2.1, 2.1, 2.1}, 1.0).agreement, Agreement::disagrees) << "3 of 3";
  EXPECT_EQ(compared({0, 2.92, 0.0, 0.0}, 1.0).agreement, Agreement::agrees);
  EXPECT_EQ(compared({0, 2.95, 0.0, 0.0}, 1.0).agreement, Agreement::disagrees) << "the largest of 3";
  // Of 1000 samples the largest lies beyond 4.42 sigma with 1 %.
  Values d(1001, 0.0);
  d[500] = 4.38;
  EXPECT_EQ(compared(d, 1.0).agreement, Agreement::agrees);
  d[500] = -4.46;
  EXPECT_EQ(compared(d, 1.0).agreement, Agreement::disagrees);
  d.assign(1001, 0.0);
  for (std::size_t i = 1; i <= 395; ++i) d[2 * i] = 2.1;
  EXPECT_TRUE(compared(d, 1.0).samples_agree);
  for (std::size_t i = 1; i <= 15; ++i) d[2 * i + 1] = 2.1;
  EXPECT_FALSE(compared(d, 1.0).samples_agree);
  EXPECT_EQ(compared(Values(1001, 0.0), 1.0).agreement, Agreement::agrees) << "no difference at all";
}

// 100000 samples: no overflow of the binomial coefficients; 40 615 beyond are 1 % (scipy).
TEST(comparison, verdict_on_many_samples) {
  Values d(100'001, 0.0);
  for (std::size_t i = 1; i <= 40'000; ++i) d[2 * i] = 2.1;
  EXPECT_TRUE(compared(d, 1.0).samples_agree);
  for (std::size_t i = 1; i <= 1'500; ++i) d[2 * i + 1] = 2.1;
  EXPECT_FALSE(compared(d, 1.0).samples_agree);
}

// Stated to be exact, and not equal.
TEST(comparison, a_sigma_of_0_agrees_with_nothing_else) {
  const Values time_s = minutes({0, 10, 20});
  MeasuredDrift a = drift("a", time_s, {0, 1, 2}, 1.0);
  a.axes[0].budget[0].sigma.assign(3, 0.0);
  EXPECT_EQ(axis_of(compare(a, drift("b", time_s, {0, 1, 2}, 0.0))).agreement, Agreement::agrees);
  EXPECT_EQ(axis_of(compare(a, drift("b", time_s, {0, 1, 2.5}, 0.0))).agreement, Agreement::disagrees);
}

TEST(comparison, without_a_sigma_it_cannot_tell) {
  const Values time_s = minutes({0, 10, 20, 30});
  const AxisComparison x =
      axis_of(compare(drift("a", time_s, {0, 1, 2, 3}, 0.0), drift("b", time_s, {0, 9, 9, 9}, 0.0)));
  EXPECT_EQ(x.agreement, Agreement::cannot_tell);
  EXPECT_EQ(x.counted, 0U);
  EXPECT_FALSE(x.deviation.has_value());
  EXPECT_FALSE(x.expected_relative_deviation.has_value());
  EXPECT_TRUE(x.budget.empty());
  EXPECT_TRUE(std::isnan(x.sigma[1]));
  EXPECT_NEAR(x.mean_relative_deviation.value(), (8.0 + 7.0 + 6.0) / 27.0, kRounding);
  // A sigma in some rows judges those.
  MeasuredDrift part = drift("a", time_s, {0, 1, 2, 3}, 0.1);
  part.axes[0].budget[0].sigma = {0.0, kGap, kGap, 0.1};
  const AxisComparison some = axis_of(compare(part, drift("b", time_s, {0, 9, 9, 3}, 0.0)));
  EXPECT_EQ(some.counted, 1U);
  EXPECT_EQ(some.agreement, Agreement::agrees);
}

// A sigma that is not determined agrees with everything, which says nothing.
TEST(comparison, an_undetermined_sigma_does_not_count) {
  constexpr double kUndetermined = std::numeric_limits<double>::infinity();
  const Values time_s = minutes({0, 10, 20, 30});
  MeasuredDrift a = drift("a", time_s, {0, 1, 2, 3}, 0.1);
  a.axes[0].budget[0].sigma = {0.0, 0.1, kUndetermined, 0.1};
  const AxisComparison some = axis_of(compare(a, drift("b", time_s, {0, 1, 9, 3}, 0.1)));
  EXPECT_EQ(some.counted, 2U);
  EXPECT_EQ(some.within, 2U);
  EXPECT_EQ(some.agreement, Agreement::agrees);
  EXPECT_FALSE(some.explained_share.has_value());
  EXPECT_NEAR(some.budget[0].sigma, 0.1, kRounding) << "of the others";
  EXPECT_NEAR(some.budget[0].variance, 0.5, kRounding);
  a.axes[0].budget[0].sigma = {0.0, kUndetermined, kUndetermined, kUndetermined};
  const AxisComparison none = axis_of(compare(a, drift("b", time_s, {0, 1, 2, 3}, 0.1)));
  EXPECT_EQ(none.agreement, Agreement::cannot_tell);
  EXPECT_EQ(none.counted, 0U);
  EXPECT_FALSE(none.deviation.has_value());
  ASSERT_EQ(none.budget.size(), 2U);
  EXPECT_TRUE(std::isnan(none.budget[0].sigma));
  EXPECT_EQ(none.budget[0].variance, 0.0);
  EXPECT_NEAR(none.budget[1].variance, 1.0, kRounding);
}

// sigma 0.1, 10 min apart: -0.3 beyond, 0.3 0.5 0.25 beyond on the other side, then within.
TEST(comparison, the_stretch_that_holds_the_worst) {
  const Values time_s = minutes({0, 10, 20, 30, 40, 50, 60});
  const MeasuredDrift zero = drift("b", time_s, Values(7, 0.0), 0.0);
  const Deviation middle =
      axis_of(compare(drift("a", time_s, {0, -0.3, 0.3, 0.5, 0.25, 0.1, 0.0}, 0.1), zero)).deviation.value();
  EXPECT_EQ(middle.from_s, 1200.0);
  EXPECT_EQ(middle.to_s, 2400.0);
  EXPECT_FALSE(middle.to_the_end);
  EXPECT_EQ(middle.largest, 0.5);
  EXPECT_NEAR(middle.sigma, 0.1, kRounding);
  EXPECT_EQ(middle.at_s, 1800.0);
  const Deviation end =
      axis_of(compare(drift("a", time_s, {0, 0.3, 0.1, 0.0, -0.3, -0.3, -0.6}, 0.1), zero)).deviation.value();
  EXPECT_EQ(end.from_s, 2400.0);
  EXPECT_TRUE(end.to_the_end);
  EXPECT_EQ(end.largest, -0.6);
}

TEST(comparison, errors) {
  const Values time_s = minutes({0, 10, 20, 30});
  const MeasuredDrift x = drift("probes.csv", time_s, {0, 1, 2, 3}, 0.1);
  MeasuredDrift nothing = x;
  nothing.axes.clear();
  struct {
    const char* message;
    MeasuredDrift a, b;
  } const cases[] = {
      {"expected an axis that both have, found radial, axial in ballbar and x in probes.csv.",
       with(drift("ballbar", time_s, {0, 1, 2, 3}, 0.1, "radial"),
            drift("ballbar", time_s, {0, 1, 2, 3}, 0.1, "axial")),
       x},
      {"expected an axis that both have, found none in probes.csv and x in probes.csv.", nothing, x},
      {"expected x in one unit, found x_mm in ballbar and x_um in probes.csv.",
       drift("ballbar", time_s, {0, 1, 2, 3}, 0.1, "x", "mm"), x},
      {"expected times in common, found 40 to 60.5 min in ballbar and 0 to 30 min in probes.csv.",
       drift("ballbar", minutes({40, 50, 60.5}), {0, 1, 2}, 0.1), x},
      {"expected times in common, found -30 to -1 min in ballbar and 0 to 30 min in probes.csv.",
       drift("ballbar", minutes({-30, -20, -1}), {0, 1, 2}, 0.1), x},
      {"expected at least 3 times in common, found 2 between 20 and 30 min in ballbar and probes.csv.",
       drift("ballbar", minutes({20, 30, 40}), {0, 1, 2}, 0.1), x},
      {"expected at least 3 times in common, found 1 at 30 min in ballbar and probes.csv.",
       drift("ballbar", minutes({30, 40, 50}), {0, 1, 2}, 0.1), x},
      {"expected rows to compare, found none in ballbar.", drift("ballbar", {}, {}, 0.0), x},
      {"expected rows to compare, found none in empty.csv.", x, drift("empty.csv", {}, {}, 0.0)},
      {"x is not compared: both have a value at 2 of the common times, 3 are needed.",
       drift("ballbar", time_s, {0, 1, kGap, kGap}, 0.1), x},
  };
  for (const auto& [message, a, b] : cases) {
    made::expect_error(message, [&, &one = a, &other = b] { compare(one, other); });
  }
}

// A window without a row of either series: both cover 14 to 16 min, neither has a row there.
TEST(comparison, common_time_without_a_row) {
  const MeasuredDrift a = drift("a", minutes({0, 10, 16}), {0, 1, 2}, 0.1);
  const MeasuredDrift b = drift("b", minutes({14, 20, 30}), {0, 1, 2}, 0.1);
  EXPECT_THROW(compare(a, b), Error);
}

}  // namespace
}  // namespace ballbar
