// Data that say little or nothing, or say it oddly: an answer, never a crash, a NaN or a wait without end.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>

#include "ballbar/diagnosis/verdict/diagnose.hpp"
#include "ballbar/error.hpp"
#include "diagnosis/made_drift.hpp"
#include "diagnosis/outcome.hpp"
#include "diagnosis/signatures/thresholds.hpp"
#include "revision/effect_test_of.hpp"

namespace ballbar {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kFew = 60;

// A speed in steps, a room, a target that follows both.
Series rows(std::size_t n = kFew, double step_s = 60.0) {
  std::mt19937_64 random(9);
  std::normal_distribution<double> normal;
  Series data;
  Column speed{"n_rpm", Role::speed, {}}, room{"T_room_degC", Role::ambient, {}}, target{"z_um", Role::measured, {}};
  const double rpm[] = {0, 6000, 2000, 9000, 0, 4000};
  double heat = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const double t = static_cast<double>(i);
    data.time_s.push_back(step_s * t);
    speed.values.push_back(rpm[i / 11 % 6]);
    room.values.push_back(21.0 + std::sin(t / 9.0));
    heat += (speed.values.back() / 1000.0 - heat) * 0.1;
    target.values.push_back(heat + 0.5 * room.values.back() + 0.1 * normal(random));
  }
  data.columns = {speed, room, target};
  return data;
}

Model by_speed() {
  Model model;
  model.targets = {"z_um"};
  model.terms = {term_of("speed_heating", {"n_rpm"})};
  return model;
}

void expect_probability(double p, const std::string& what) {
  EXPECT_TRUE(p >= -1e-9 && p <= 1.0 + 1e-9) << what << " " << p;
}

// Numbers where numbers are due; of a verdict of something, that something.
void expect_answer(const Diagnosis& found) {
  const std::string what(name_of(found.verdict));
  expect_probability(found.p_nothing, what);
  expect_probability(found.p_discrepancy, what);
  EXPECT_TRUE(std::isfinite(found.discrepancy_um)) << what;
  EXPECT_TRUE(std::isfinite(found.discrepancy_time_s)) << what;
  EXPECT_TRUE(std::isfinite(found.level_jump_um)) << what;
  EXPECT_FALSE(std::isnan(found.hidden_um)) << what;
  EXPECT_TRUE(std::isfinite(found.base.rmse_um)) << what;
  if (found.verdict != Verdict::untestable) {
    EXPECT_TRUE(std::isfinite(found.rmse_after_um)) << what;
  }
  EXPECT_TRUE(std::isfinite(found.noise.white_um) && std::isfinite(found.noise.correlated_um)) << what;
  for (const EffectProbability& one : found.effects) expect_probability(one.p, label_of(one.bound));
  for (const Driver& driver : found.drivers) expect_probability(driver.p, driver.column);
  for (const OwnValue& own : found.own) {
    expect_probability(own.p, own.parameter);
    EXPECT_TRUE(std::isfinite(own.fitted)) << own.parameter;
    const bool is_stated = own.p >= kProbable && found.p_discrepancy < kDiscrepancy &&
                           (found.verdict == Verdict::named || found.verdict == Verdict::probable);
    EXPECT_FALSE(is_stated && (std::isnan(own.interval.low) || std::isnan(own.interval.high))) << own.parameter;
  }
  for (const Candidate& one : found.candidates) {
    expect_probability(one.p, one.label);
    EXPECT_FALSE(std::isnan(one.likelihood_ratio)) << one.label;
    EXPECT_TRUE(std::isfinite(one.amplitude_um)) << one.label;
    EXPECT_TRUE(std::isfinite(one.rmse_after_um)) << one.label;
    EXPECT_FALSE(std::isnan(one.p_same_gain)) << one.label;
    for (const FittedParameter& parameter : one.parameters) EXPECT_TRUE(std::isfinite(parameter.value)) << one.label;
  }
}

Diagnosis answered(const Series& data, const Model& model = by_speed()) {
  Diagnosis found = diagnose(model, data);
  expect_answer(found);
  return found;
}

void fill(Series& data, const std::string& name, double value) {
  std::vector<double>& values = made::values_of(data, name);
  std::fill(values.begin(), values.end(), value);
}

TEST(Degenerate, nothing_odd) { answered(rows()); }

TEST(Degenerate, a_constant_target) {
  for (const double value : {0.0, 5.0, -1e-7}) {
    Series data = rows();
    fill(data, "z_um", value);
    const Diagnosis found = answered(data);
    EXPECT_TRUE(found.named.empty() && found.probable.empty()) << value;
    EXPECT_TRUE(found.equivalent.empty()) << value;
  }
}

TEST(Degenerate, of_three_to_thirty_rows) {
  for (std::size_t n = 3; n <= 31; n += n < 12 ? 1 : 6) {
    const Diagnosis found = answered(rows(n));
    EXPECT_TRUE(n >= 5 || found.verdict == Verdict::untestable) << n;
  }
}

TEST(Degenerate, of_fewer_rows_is_an_error) {
  for (std::size_t n = 0; n < 3; ++n) EXPECT_THROW(diagnose(by_speed(), rows(n)), Error) << n;
}

TEST(Degenerate, two_equal_columns) {
  Series data = rows();
  data.columns.push_back(data.columns[1]);
  data.columns.back().name = "T_same_degC";
  data.columns.push_back(data.columns[0]);
  data.columns.back().name = "m_rpm";
  EXPECT_TRUE(answered(data).named.empty());
}

// What the target is, exactly: one effect leaves nothing at all.
TEST(Degenerate, a_target_that_is_an_input) {
  Series data = rows();
  made::values_of(data, "z_um") = made::values_of(data, "T_room_degC");
  answered(data);
  Model constant;
  constant.targets = {"z_um"};
  answered(data, constant);
}

// And one that the model makes, exactly.
TEST(Degenerate, a_target_that_is_the_model) {
  Series data = rows();
  for (std::size_t i = 0; i < kFew; ++i)
    made::values_of(data, "z_um")[i] = 3.0 + 2.0 * made::values_of(data, "T_room_degC")[i];
  Model model;
  model.targets = {"z_um"};
  model.terms = {term_of("expansion", {"T_room_degC"})};
  const Diagnosis found = answered(data, model);
  EXPECT_TRUE(found.named.empty()) << made::outcome_of(found);
}

TEST(Degenerate, columns_of_zeros) {
  for (const char* name : {"n_rpm", "T_room_degC"}) {
    Series data = rows();
    fill(data, name, 0.0);
    answered(data);
  }
  Series data = rows();
  fill(data, "n_rpm", 0.0);
  fill(data, "T_room_degC", 0.0);
  answered(data);
}

TEST(Degenerate, jumps_at_the_ends) {
  for (const std::size_t row : {std::size_t{0}, std::size_t{1}, kFew - 2, kFew - 1}) {
    Series data = rows();
    fill(data, "n_rpm", 0.0);
    made::values_of(data, "n_rpm")[row] = 6000.0;
    answered(data);
    for (std::size_t i = row; i < kFew; ++i) made::values_of(data, "n_rpm")[i] = 6000.0;
    answered(data);
  }
}

TEST(Degenerate, a_speed_that_changes_at_every_row) {
  Series data = rows();
  for (std::size_t i = 0; i < kFew; ++i) made::values_of(data, "n_rpm")[i] = i % 2 == 0 ? 0.0 : 6000.0;
  answered(data);
}

TEST(Degenerate, readings_large_and_small) {
  for (const double factor : {1e9, 1e-9}) {
    Series data = rows();
    for (double& value : made::values_of(data, "z_um")) value *= factor;
    answered(data);
  }
}

TEST(Degenerate, inputs_large_and_small) {
  for (const double factor : {1e9, 1e-9}) {
    for (const char* name : {"n_rpm", "T_room_degC"}) {
      Series data = rows();
      for (double& value : made::values_of(data, name)) value *= factor;
      answered(data);
    }
  }
}

TEST(Degenerate, steps_of_a_millisecond_and_of_a_day) {
  for (const double step_s : {0.001, 1.0, 86400.0}) answered(rows(kFew, step_s));
}

TEST(Degenerate, huge_gaps_of_time) {
  Series data = rows();
  for (std::size_t i = 20; i < kFew; ++i) data.time_s[i] += 1e7;
  for (std::size_t i = 40; i < kFew; ++i) data.time_s[i] += 1e9;
  answered(data);
}

TEST(Degenerate, an_input_without_values) {
  Series data = rows();
  data.columns.push_back({"T_dead_degC", Role::structure, std::vector<double>(kFew, kNaN)});
  data.columns.push_back({"m_rpm", Role::speed, std::vector<double>(kFew, kNaN)});
  const Diagnosis found = answered(data);
  for (const EffectProbability& one : found.effects) EXPECT_EQ(label_of(one.bound).find("T_dead"), std::string::npos);
}

TEST(Degenerate, inputs_and_target_with_gaps) {
  Series data = rows();
  for (std::size_t i = 0; i < kFew; ++i) {
    if (i % 3 != 0) made::values_of(data, "z_um")[i] = kNaN;
    if (i % 5 == 4) made::values_of(data, "T_room_degC")[i] = kNaN;
  }
  answered(data);
  made::values_of(data, "T_room_degC").front() = made::values_of(data, "T_room_degC").back() = kNaN;
  answered(data);
}

TEST(Degenerate, a_target_without_values_is_an_error) {
  Series data = rows();
  fill(data, "z_um", kNaN);
  EXPECT_THROW(diagnose(by_speed(), data), Error);
}

TEST(Degenerate, one_reading_far_from_the_others) {
  for (const double far_um : {1e3, 1e9}) {
    Series data = rows();
    made::values_of(data, "z_um")[33] += far_um;
    answered(data);
  }
}

// Stated sigmas of nothing, of very much, and of gaps.
TEST(Degenerate, sigmas_that_differ_much) {
  Series data = rows();
  Column sigma{"z_sigma_um", Role::measured, {}};
  for (std::size_t i = 0; i < kFew; ++i) sigma.values.push_back(i % 2 == 0 ? 1e-6 : 1e3);
  data.columns.push_back(sigma);
  answered(data);
}

TEST(Degenerate, a_model_that_holds_everything) {
  Model model = by_speed();
  model.constant_um = 0.0;
  for (Setting& setting : model.terms[0].settings) setting.held = true;
  model.terms[0].settings[0].start = 0.4;
  answered(rows(), model);
}

// A model with the same column under two names: a direction of it is not determined.
TEST(Degenerate, a_model_of_equal_columns) {
  Series data = rows();
  data.columns.push_back(data.columns[1]);
  data.columns.back().name = "T_same_degC";
  Model model = by_speed();
  model.terms.push_back(term_of("expansion", {"T_room_degC"}));
  model.terms.push_back(term_of("expansion", {"T_same_degC"}));
  answered(data, model);
}

// Nothing but time: effects of time alone are never named.
TEST(Degenerate, without_inputs) {
  Series data = rows();
  data.columns.erase(data.columns.begin(), data.columns.begin() + 2);
  Model constant;
  constant.targets = {"z_um"};
  const Diagnosis found = answered(data, constant);
  EXPECT_TRUE(found.named.empty());
  EXPECT_TRUE(found.drivers.empty());
}

// What is tried is answered as well.
TEST(Degenerate, effects_that_are_tried) {
  std::vector<Series> all{rows(), rows(), rows(8), rows()};
  fill(all[1], "T_room_degC", 20.0);
  made::values_of(all[3], "z_um") = made::values_of(all[3], "T_room_degC");
  for (const Series& data : all) {
    for (const Term& term : {term_of("expansion", {"T_room_degC"}), term_of("lagged_expansion", {"T_room_degC"}),
                             term_of("centrifugal_shift", {"n_rpm"}), term_of("linear_drift", {})}) {
      const EffectTest found = effect_test(by_speed(), {term}, data);
      ASSERT_EQ(found.added.size(), 1U);
      EXPECT_FALSE(std::isnan(found.added[0].likelihood_ratio)) << found.added[0].label;
      EXPECT_TRUE(std::isfinite(found.added[0].amplitude_um)) << found.added[0].label;
      EXPECT_FALSE(std::isnan(found.after.likelihood_ratio));
      EXPECT_TRUE(std::isfinite(found.after.rmse_um));
      EXPECT_FALSE(found.after.verdict.empty());
      for (const DropTest& drop : found.earlier) expect_probability(drop.p, drop.label);
    }
  }
}

}  // namespace
}  // namespace ballbar
