#include <gtest/gtest.h>

#include <cmath>

#include "ballbar/error.hpp"
#include "ballbar/fit/fit.hpp"
#include "ballbar/internal/model/run_terms.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {
namespace {

Series run_of(const std::vector<double>& speed, double begin_s = 0.0) {
  Series run;
  for (std::size_t i = 0; i < speed.size(); ++i) run.time_s.push_back(begin_s + 60.0 * static_cast<double>(i));
  run.columns = {{"speed_rpm", Role::speed, speed}, {"z_um", Role::measured, speed}};
  return run;
}

TEST(runs, begin_where_time_falls) {
  const std::vector<double> time_s{0.0, 1.0, 2.0, 0.0, 1.0, 0.5};
  const std::vector<RowRange> runs = runs_of(time_s);
  ASSERT_EQ(runs.size(), 3u);
  EXPECT_EQ(runs[1].begin, 3u);
  EXPECT_EQ(runs[1].end, 5u);
  EXPECT_EQ(runs[2].end, 6u);
  EXPECT_TRUE(runs_of({}).empty());
}

TEST(runs, stacked_from_zero_each_with_its_name) {
  Series second = run_of({0.0, 300.0, 400.0}, 1000.0);
  second.columns.push_back({"T_oil_degC", Role::coolant, {20.0, 20.0, 20.0}});
  const Stacked all = stacked({run_of({0.0, 100.0}), second}, {"a.csv", "b.csv"});
  EXPECT_EQ(all.series.time_s, (std::vector<double>{0.0, 60.0, 0.0, 60.0, 120.0}));
  EXPECT_EQ(all.series.columns[0].values, (std::vector<double>{0.0, 100.0, 0.0, 300.0, 400.0}));
  ASSERT_EQ(all.series.runs.size(), 2u);
  EXPECT_EQ(all.series.runs[1].name, "b.csv");
  ASSERT_EQ(all.remarks.size(), 1u);
  EXPECT_EQ(all.remarks[0], "left out, as not all runs have it: T_oil_degC");
}

TEST(runs, one_that_turns_in_its_first_row_begins_warm) {
  const Stacked all = stacked({run_of({0.0, 100.0}), run_of({200.0, 100.0})}, {"a", "b"});
  EXPECT_EQ(all.series.runs[0].start, RunStart::rest);
  EXPECT_EQ(all.series.runs[1].start, RunStart::warm);
}

TEST(runs, one_soon_after_another_begins_warm) {
  const Series a = run_of({0.0, 100.0}), b = run_of({0.0, 200.0}), c = run_of({0.0, 300.0});
  const double hour_s = 3600.0;
  const Stacked all = stacked({a, b, c}, {"a", "b", "c"}, {8.0 * hour_s, 10.0 * hour_s, 34.0 * hour_s});
  EXPECT_EQ(all.series.runs[0].start, RunStart::rest);
  EXPECT_EQ(all.series.runs[1].start, RunStart::warm);
  EXPECT_EQ(all.series.runs[2].start, RunStart::rest);
}

struct Refused {
  const char* what;
  std::vector<Series> runs;
  const char* message;
  std::vector<std::optional<double>> zeros_s = {};
};

TEST(runs, what_is_refused) {
  Series kelvin = run_of({0.0, 100.0, 200.0}), celsius = run_of({0.0, 300.0});
  kelvin.columns.push_back({"T_bed_K", Role::structure, {0.0, 1.0, 2.0}});
  celsius.columns.push_back({"T_bed_degC", Role::structure, {20.0, 21.0}});
  Series other = run_of({0.0, 100.0});
  other.columns = {{"T_bed_degC", Role::structure, {20.0, 21.0}}};
  const Series early = run_of({0.0, 100.0}), late = run_of({0.0, 200.0});
  Series short_one = run_of({0.0});
  const std::vector<Refused> cases{
      {"the same rows",
       {run_of({0.0, 100.0}), run_of({0.0, 100.0}, 500.0)},
       "expected every run once, found the same rows in a.csv and b.csv."},
      {"units",
       {celsius, kelvin},
       "expected the columns of all runs in the same units, found T_bed_degC in a.csv and T_bed_K in b.csv."},
      {"nothing in common",
       {other, run_of({0.0, 100.0})},
       "expected a column that all of a.csv, b.csv have, found none."},
      {"overlap",
       {early, late},
       "expected runs of one machine one after another, found a.csv and b.csv, which overlap by their clocks; where "
       "they "
       "are two logs of one run, `ballbar import` makes one of them.",
       {0.0, 30.0}},
      {"one row", {run_of({0.0, 100.0}), short_one}, "b.csv: expected a run of at least 2 rows, found 1."}};
  for (const Refused& one : cases) {
    try {
      stacked(one.runs, {"a.csv", "b.csv"}, one.zeros_s);
      ADD_FAILURE() << one.what;
    } catch (const Error& error) {
      EXPECT_STREQ(error.what(), one.message) << one.what;
    }
  }
}

// A low pass of the speed, 2 um/krpm at 1200 s, that begins anew in each run; zeros of 5 and -40 um.
Series two_runs(double warm_um) {
  Series all;
  std::vector<double> speed, z;
  for (int run = 0; run < 2; ++run) {
    double x = 0.0, last = 0.0;
    for (int i = 0; i < 200; ++i) {
      const double rpm = i < 20 ? 0.0 : i < 110 ? 3000.0 + 2000.0 * run : 1000.0;
      const double u = rpm / 1000.0, a = 1.0 - std::exp(-60.0 / 1200.0);
      if (i > 0) x += a * (last - x) + (u - last) * (1.0 - a * 1200.0 / 60.0);
      last = u;
      all.time_s.push_back(60.0 * i);
      speed.push_back(rpm);
      const double warm = run == 1 ? warm_um * std::exp(-60.0 * i / 2400.0) : 0.0;
      z.push_back(2.0 * x + (run == 0 ? 5.0 : -40.0) + warm);
    }
  }
  all.columns = {{"speed_rpm", Role::speed, speed}, {"z_um", Role::measured, z}};
  all.runs = {{"a", RunStart::rest}, {"b", warm_um == 0.0 ? RunStart::rest : RunStart::warm}};
  return all;
}

Model heated(const Series& data) {
  Model model;
  model.targets = {"z_um"};
  model.terms = {term_of("speed_heating", {"speed_rpm"})};
  for (std::size_t k = 0; k < model.terms[0].settings.size(); ++k) {
    if (model.terms[0].effect->parameters[k].name != "exponent") continue;
    model.terms[0].settings[k].start = 1.0;
    model.terms[0].settings[k].held = true;
  }
  return with_run_terms(model, data);
}

double value_of(const Fit& fit, const std::string& effect, const std::string& name) {
  for (const FittedParameter& one : fit.parameters) {
    if (one.effect == effect && one.name == name) return one.value;
  }
  ADD_FAILURE() << effect << " " << name;
  return 0.0;
}

TEST(runs, share_gains_and_shapes_and_have_a_zero_each) {
  const Series data = two_runs(0.0);
  const Fit found = fit(heated(data), data, 0, {.white = true});
  EXPECT_NEAR(value_of(found, "constant", "constant_um"), 5.0, 1e-6);
  EXPECT_NEAR(value_of(found, "offset_of_run 2", "gain_um"), -45.0, 1e-6);
  EXPECT_NEAR(value_of(found, "speed_heating(speed_rpm)", "time_constant_s"), 1200.0, 1e-3);
  EXPECT_LT(found.rmse_um, 1e-6);
}

TEST(runs, a_warm_start_is_fitted) {
  const Series data = two_runs(8.0);
  const Fit found = fit(heated(data), data, 0, {.white = true});
  EXPECT_NEAR(value_of(found, "start_of_run 2", "gain_um"), 8.0, 1e-4);
  EXPECT_NEAR(value_of(found, "start_of_run 2", "time_constant_s"), 2400.0, 0.1);
  EXPECT_LT(found.rmse_um, 1e-5);
}

TEST(runs, terms_of_a_set_up_are_taken_out_again) {
  const Series data = two_runs(8.0);
  const Model model = heated(data);
  EXPECT_EQ(model.terms.size(), 3u);
  EXPECT_EQ(without_run_terms(model).terms.size(), 1u);
}

}  // namespace
}  // namespace ballbar
