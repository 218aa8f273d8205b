// What is predicted row by row is what is predicted at once; where a record goes on from training, and where not.
#include <gtest/gtest.h>

#include <limits>

#include "allocations.hpp"
#include "ballbar/predict/train.hpp"
#include "ballbar/series/series.hpp"
#include "made_runs.hpp"

// The linker sends malloc and calloc of the program and of the library here, so that what Eigen takes is seen.
extern "C" {
void* __real_malloc(std::size_t size);
void* __real_calloc(std::size_t count, std::size_t size);
std::size_t g_mallocs = 0;
void* __wrap_malloc(std::size_t size) {
  ++g_mallocs;
  return __real_malloc(size);
}
void* __wrap_calloc(std::size_t count, std::size_t size) {
  ++g_mallocs;
  return __real_calloc(count, size);
}
}

namespace ballbar {
namespace {

using made::same;

constexpr std::size_t kTrained = 400;

EffectRegression trained(const Series& series) {
  EffectRegressionOptions options;
  options.forecasts = false;
  return effect_regression({&series, 1}, "z_um", options);
}

// A record with a discrepancy, the rows that are trained on and those after them.
struct Cut {
  Series whole = made::run({.wander_um = 4.0}, "live_prediction");
  Series first = rows_of(whole, {0, kTrained}), rest = rows_of(whole, {kTrained, whole.time_s.size()});
  EffectRegression regression = trained(first);
};

const Cut& cut() {
  static const Cut one;
  return one;
}

std::vector<LivePrediction::At> row_by_row(LivePrediction& live, const Series& series) {
  std::vector<const Column*> columns;
  for (const std::string& name : live.columns()) columns.push_back(find_column(series, name));
  std::vector<LivePrediction::At> all;
  std::vector<double> values(columns.size());
  for (std::size_t i = 0; i < series.time_s.size(); ++i) {
    for (std::size_t c = 0; c < columns.size(); ++c) values[c] = columns[c]->values[i];
    all.push_back(live.next(series.time_s[i], values));
  }
  return all;
}

void expect_same(const std::vector<LivePrediction::At>& live, const RegressionPrediction& at_once,
                 std::size_t from = 0) {
  ASSERT_EQ(live.size() + from, at_once.predicted_um.size());
  std::size_t others = 0;
  for (std::size_t i = 0; i < live.size(); ++i) {
    if (!same(live[i].predicted_um, at_once.predicted_um[from + i])) ++others;
    if (!same(live[i].half_width_um, at_once.half_width_um[from + i])) ++others;
  }
  EXPECT_EQ(others, 0U);
}

TEST(live_prediction, row_by_row_is_at_once_to_the_last_bit) {
  Series other = made::run({}, "row_by_row");
  made::values_of(other, "T_base_degC")[70] = std::numeric_limits<double>::quiet_NaN();
  LivePrediction live(cut().regression);
  const std::vector<LivePrediction::At> all = row_by_row(live, other);
  const RegressionPrediction at_once = predict(cut().regression, other);
  expect_same(all, at_once);
  EXPECT_TRUE(std::isnan(at_once.predicted_um[70]) && std::isnan(at_once.half_width_um[70]));
  EXPECT_TRUE(std::isfinite(at_once.predicted_um[69]) && std::isfinite(at_once.predicted_um[71]));
}

// More rows than are worked on together, one without a value among the later ones.
TEST(live_prediction, row_by_row_is_at_once_over_many_rows) {
  Series other = made::run({.rows = 20000}, "many_rows");
  made::values_of(other, "T_base_degC")[17000] = std::numeric_limits<double>::quiet_NaN();
  LivePrediction live(cut().regression);
  const RegressionPrediction at_once = predict(cut().regression, other);
  expect_same(row_by_row(live, other), at_once);
  EXPECT_EQ(live.state().time_s, at_once.end.live.time_s);
  EXPECT_EQ(live.state().inputs, at_once.end.live.inputs);
  EXPECT_EQ(live.state().kept, at_once.end.live.kept);
}

TEST(live_prediction, what_goes_on_from_training_is_what_the_whole_record_gives) {
  const EffectRegression& regression = cut().regression;
  ASSERT_GT(regression.length_s, 0.0);
  ASSERT_GT(std::abs(regression.end_discrepancy_um), 0.01);
  const RegressionPrediction whole = predict(regression, cut().whole), rest = predict(regression, cut().rest);
  EXPECT_TRUE(whole.holds && !whole.goes_on);
  EXPECT_TRUE(rest.goes_on && !rest.holds);
  LivePrediction live(regression);
  live.go_on();
  const std::vector<LivePrediction::At> all = row_by_row(live, cut().rest);
  expect_same(all, rest);
  expect_same(all, whole, kTrained);
  EXPECT_NE(live.discrepancy_um(), 0.0);

  // Interrupted, stored and taken up again.
  LivePrediction one(regression), other(regression);
  one.go_on();
  const Series half = rows_of(cut().rest, {0, 100}), others = rows_of(cut().rest, {100, 200});
  row_by_row(one, half);
  other.resume(one.state(), one.goes_on());
  expect_same(row_by_row(other, others), whole, kTrained + 100);
}

// Just after training the interval is narrower with the discrepancy than without.
TEST(live_prediction, the_discrepancy_goes_on_and_is_forgotten) {
  const EffectRegression& regression = cut().regression;
  LivePrediction with(regression), without(regression);
  with.go_on();
  without.resume(regression.end, false);
  const std::vector<LivePrediction::At> a = row_by_row(with, cut().rest), b = row_by_row(without, cut().rest);
  const double since_s = cut().rest.time_s[20] - regression.end_s;
  EXPECT_NEAR(a[20].predicted_um - b[20].predicted_um,
              regression.end_discrepancy_um * std::exp(-since_s / regression.length_s), 1e-9);
  EXPECT_LT(a.front().half_width_um, 0.9 * b.front().half_width_um);
}

TEST(live_prediction, a_new_run_has_no_discrepancy) {
  const EffectRegression& regression = cut().regression;
  const Series other = made::run({.start_s = 500.0}, "new_run");
  const RegressionPrediction prediction = predict(regression, other);
  EXPECT_FALSE(prediction.goes_on || prediction.holds);
  LivePrediction live(regression);
  row_by_row(live, other);
  EXPECT_EQ(live.discrepancy_um(), 0.0);
  EXPECT_FALSE(live.goes_on());
  for (std::size_t i = 0; i < other.time_s.size(); ++i) {
    const double sum = *regression.model.constant_um + prediction.drivers_um.row(static_cast<Eigen::Index>(i)).sum();
    ASSERT_NEAR(prediction.predicted_um[i], sum, 1e-9 * (1.0 + prediction.drivers_um.cwiseAbs().maxCoeff()));
  }
}

// The largest share first, and each with what the terms on its column add.
TEST(live_prediction, drivers_are_sorted_with_what_they_add) {
  const EffectRegression& regression = cut().regression;
  const Series other = made::run({.rows = 50}, "drivers");
  const RegressionPrediction prediction = predict(regression, other);
  ASSERT_GE(prediction.drivers.size(), 2U);
  LivePrediction live(regression);
  row_by_row(live, other);
  for (std::size_t d = 0; d < prediction.drivers.size(); ++d) {
    double sum_um = 0.0;
    for (std::size_t t = 0; t < regression.model.terms.size(); ++t) {
      if (regression.model.terms[t].columns.front() != prediction.drivers[d].column) continue;
      sum_um += live.contributions_um()[t];
    }
    EXPECT_EQ(prediction.drivers_um(49, static_cast<Eigen::Index>(d)), sum_um) << prediction.drivers[d].column;
    if (d == 0) continue;
    EXPECT_LE(std::abs(prediction.drivers[d].share_um), std::abs(prediction.drivers[d - 1].share_um));
  }
}

// A run that begins at the same time with the same first row as training did, and is another.
TEST(live_prediction, an_equal_first_row_does_not_hold_the_training) {
  Series other = made::run({.rows = kTrained + 50}, "equal_first_row");
  for (const Column& column : cut().whole.columns) made::values_of(other, column.name)[0] = column.values[0];
  ASSERT_EQ(other.time_s[0], cut().whole.time_s[0]);
  EXPECT_FALSE(predict(cut().regression, other).holds);
}

TEST(live_prediction, a_gap_of_more_than_ten_steps_is_not_gone_over) {
  const auto after = [](double steps) {
    Series rest = cut().rest;
    for (double& time_s : rest.time_s) time_s += 30.0 * (steps - 1.0);
    return predict(cut().regression, rest).goes_on;
  };
  EXPECT_TRUE(after(1.0));
  EXPECT_TRUE(after(10.0));
  EXPECT_FALSE(after(10.5));
  EXPECT_FALSE(after(0.0));  // the last row again
}

TEST(live_prediction, takes_no_memory) {
  LivePrediction live(cut().regression);
  std::vector<double> values(live.columns().size(), 20.0);
  live.next(0.0, values);
  const std::size_t before = allocations(), mallocs = g_mallocs;
  ASSERT_GT(mallocs, 0U);
  for (int i = 1; i < 1000; ++i) {
    values[0] = i % 7 == 0 ? std::numeric_limits<double>::quiet_NaN() : 20.0 + 0.01 * i;
    live.next(i, values);
  }
  EXPECT_EQ(allocations(), before);
  EXPECT_EQ(g_mallocs, mallocs);
}

}  // namespace
}  // namespace ballbar
