// What a log tells of its inputs: exact, held, straight lines between samples, rounded.
#include "diagnosis/evidence/logged_inputs.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace ballbar {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

Series rows_of(std::size_t n, double step_s) {
  Series data;
  for (std::size_t i = 0; i < n; ++i) data.time_s.push_back(step_s * static_cast<double>(i));
  return data;
}

// Speeds that last some minutes, changed between two rows of 15 s, at 35 s past a minute among others.
double rpm_at(double time_s) {
  const double changes_s[] = {400.0, 1000.0, 1435.0, 2000.0, 2590.0, 3100.0, 3700.0, 4400.0, 5000.0, 5500.0};
  const double rpm[] = {0.0, 3000.0, 6000.0, 1000.0, 8000.0, 0.0, 4000.0, 9000.0, 2000.0, 5000.0, 0.0};
  std::size_t k = 0;
  while (k < 10 && time_s >= changes_s[k]) ++k;
  return rpm[k];
}

// 19 to 25 degC in slow waves.
double degC_at(double time_s) { return 22.0 + 2.0 * std::sin(time_s / 2200.0) + std::sin(time_s / 900.0 + 1.0); }

std::vector<double> read(const Series& data, double (*at)(double)) {
  std::vector<double> values;
  for (const double t : data.time_s) values.push_back(at(t));
  return values;
}
// Asked every `every` rows, the value held in between.
std::vector<double> held(const std::vector<double>& values, std::size_t every, std::size_t first) {
  std::vector<double> result = values;
  for (std::size_t i = 1; i < values.size(); ++i) result[i] = i % every == first ? values[i] : result[i - 1];
  return result;
}
// Straight lines between every `every` rows.
std::vector<double> ramped(const std::vector<double>& values, std::size_t every) {
  std::vector<double> result = values;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::size_t before = i / every * every, after = before + every;
    if (after >= values.size()) break;
    const double share = static_cast<double>(i - before) / static_cast<double>(every);
    result[i] = values[before] + share * (values[after] - values[before]);
  }
  return result;
}

const LoggedInput& input(const LoggedInputs& found, const std::string& column) {
  for (const LoggedInput& one : found.inputs) {
    if (one.column == column) return one;
  }
  ADD_FAILURE() << column;
  return found.inputs.front();
}

double rms_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += std::pow(a[i] - b[i], 2) / static_cast<double>(a.size());
  return std::sqrt(sum);
}

TEST(LoggedInputs, an_exact_speed_stays_and_changes_between_two_rows) {
  Series data = rows_of(400, 15.0);
  data.columns = {{"n_rpm", Role::speed, read(data, rpm_at)}};
  const LoggedInputs found = logged_inputs(data, {"z_um"});
  EXPECT_EQ(found.series.columns[0].values, data.columns[0].values);
  const LoggedInput& speed = input(found, "n_rpm");
  EXPECT_TRUE(speed.is_stepped);
  ASSERT_EQ(speed.jumps.size(), 10U);
  // 400 s: row 26 (390 s) is at rest, row 27 (405 s) is not.
  EXPECT_EQ(speed.jumps[0].first, 26U);
  EXPECT_EQ(speed.jumps[0].last, 27U);
  EXPECT_EQ(speed.jumps[0].before, 0.0);
  EXPECT_EQ(speed.jumps[0].after, 3000.0);
  EXPECT_EQ(speed.jumps[9].before, 5000.0);
  EXPECT_EQ(speed.jumps[9].after, 0.0);
}

// A speed asked once a minute beside a temperature that is: each change may have been at any of the four rows before it
// shows. Drawn in the middle of them, at two rows of four: half a sample earlier than it shows.
TEST(LoggedInputs, a_held_speed_changes_in_the_middle_of_its_sample) {
  Series data = rows_of(400, 15.0);
  const std::vector<double> exact = read(data, rpm_at);
  const std::vector<double> degC = read(data, degC_at);
  data.columns = {{"n_rpm", Role::speed, held(exact, 4, 2)}, {"T_degC", Role::structure, held(degC, 4, 2)}};
  const LoggedInputs found = logged_inputs(data, {});
  const LoggedInput& speed = input(found, "n_rpm");
  EXPECT_EQ(speed.late_s, 60.0);
  ASSERT_EQ(speed.jumps.size(), 10U);
  for (const Jump& jump : speed.jumps) {
    EXPECT_EQ(jump.last - jump.first, 4U);
    EXPECT_EQ(jump.last % 4, 2U);
    const std::vector<double>& drawn = found.series.columns[0].values;
    EXPECT_EQ(drawn[jump.first + 1], jump.before);
    EXPECT_EQ(drawn[jump.first + 2], 0.5 * (jump.before + jump.after));
    EXPECT_EQ(drawn[jump.first + 3], jump.after);
  }
  // Nearer to what it was than what was logged.
  EXPECT_LT(rms_difference(found.series.columns[0].values, exact), rms_difference(data.columns[0].values, exact));
}

TEST(LoggedInputs, a_held_temperature_is_drawn_through_its_samples) {
  Series data = rows_of(400, 15.0);
  const std::vector<double> degC = read(data, degC_at);
  data.columns = {{"T_degC", Role::structure, held(degC, 4, 1)}};
  const LoggedInputs found = logged_inputs(data, {});
  EXPECT_EQ(input(found, "T_degC").late_s, 60.0);
  EXPECT_FALSE(input(found, "T_degC").is_stepped);
  const double before_K = rms_difference(data.columns[0].values, degC);
  EXPECT_GT(before_K, 0.01);
  EXPECT_LT(rms_difference(found.series.columns[0].values, degC), 0.2 * before_K);
}

// A straight line of four rows between a speed and another one: a step in its middle.
// A thermometer that hardly ever changes says nothing of how often the others are asked.
TEST(LoggedInputs, a_dead_thermometer_does_not_tell_the_sampling) {
  Series data = rows_of(400, 15.0);
  data.columns.push_back({"T_room_degC", Role::ambient, held(read(data, degC_at), 4, 1)});
  data.columns.push_back({"T_dead_degC", Role::structure, std::vector<double>(400, 20.0)});
  data.columns.back().values.back() = 20.1;
  data.columns.push_back({"speed_rpm", Role::speed, held(read(data, rpm_at), 4, 1)});
  EXPECT_EQ(input(logged_inputs(data, {}), "speed_rpm").late_s, 60.0);
}

TEST(LoggedInputs, a_ramped_speed_is_a_step) {
  Series data = rows_of(400, 15.0);
  const std::vector<double> exact = read(data, rpm_at);
  data.columns = {{"n_rpm", Role::speed, ramped(exact, 4)},
                  {"T_degC", Role::structure, ramped(read(data, degC_at), 4)}};
  const LoggedInputs found = logged_inputs(data, {});
  const LoggedInput& speed = input(found, "n_rpm");
  EXPECT_TRUE(speed.is_stepped);
  ASSERT_EQ(speed.jumps.size(), 10U);
  const std::vector<double>& drawn = found.series.columns[0].values;
  for (const Jump& jump : speed.jumps) {
    EXPECT_EQ(jump.last - jump.first, 4U);
    EXPECT_EQ(jump.first % 4, 0U);
    EXPECT_EQ(drawn[jump.first + 1], jump.before);
    EXPECT_EQ(drawn[jump.first + 2], 0.5 * (jump.before + jump.after));
    EXPECT_EQ(drawn[jump.first + 3], jump.after);
  }
}

// A machine whose speed changes every 30 rows: its bearing bends there alone, but its noise is no straight line.
TEST(LoggedInputs, bends_at_full_hours_are_no_samples) {
  Series data = rows_of(240, 60.0);
  std::vector<double> degC;
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal(0.0, 0.03);
  double body = 20.0;
  for (std::size_t i = 0; i < 240; ++i) {
    const double end = i / 30 % 2 == 0 ? 20.0 : 45.0;
    body += 0.5 * (end - body);
    degC.push_back(std::round(100.0 * (body + normal(random))) / 100.0);
  }
  data.columns = {{"bearing_degC", Role::bearing, degC}};
  EXPECT_EQ(input(logged_inputs(data, {}), "bearing_degC").late_s, 60.0);
}

// Moved by a whole sample to either side: over all of the rows in which it may have been.
TEST(LoggedInputs, a_jump_is_moved_to_the_ends_of_its_window) {
  const Jump jump{2, 4, 0.0, 10.0};
  const std::vector<double> values{0, 0, 0, 5, 10, 10};
  EXPECT_EQ(with_jump_moved(values, jump, true), (std::vector<double>{0, 0, 10, 10, 10, 10}));
  EXPECT_EQ(with_jump_moved(values, jump, false), (std::vector<double>{0, 0, 0, 0, 0, 10}));
}

// To 0.1 K: a curve of 6 K that moves by 0.1 K in some 40 s at the fastest.
TEST(LoggedInputs, a_coarse_temperature_is_the_smooth_curve_through_its_runs) {
  Series data = rows_of(1000, 15.0);
  const std::vector<double> degC = read(data, degC_at);
  std::vector<double> coarse = degC;
  for (double& value : coarse) value = std::round(10.0 * value) / 10.0;
  data.columns = {{"T_degC", Role::structure, coarse}};
  const LoggedInputs found = logged_inputs(data, {});
  EXPECT_GT(rms_difference(coarse, degC), 0.027);  // 0.1 K / sqrt(12) is 0.029
  EXPECT_LT(rms_difference(found.series.columns[0].values, degC), 0.02);
}

// The same with noise that makes it go to and fro between two steps.
TEST(LoggedInputs, a_coarse_temperature_with_noise_gets_no_worse) {
  Series data = rows_of(1000, 15.0);
  const std::vector<double> degC = read(data, degC_at);
  std::mt19937_64 random(3);
  for (const double sigma_K : {0.003, 0.01, 0.03, 0.1}) {
    std::normal_distribution<double> noise(0.0, sigma_K);
    std::vector<double> coarse = degC;
    for (double& value : coarse) value = std::round(10.0 * (value + noise(random))) / 10.0;
    data.columns = {{"T_degC", Role::structure, coarse}};
    const LoggedInputs found = logged_inputs(data, {});
    EXPECT_LT(rms_difference(found.series.columns[0].values, degC), 0.8 * rms_difference(coarse, degC)) << sigma_K;
  }
}

// Nothing to mend: what is drawn stays within the noise of what was read, and comes no farther from what it was.
TEST(LoggedInputs, a_fine_temperature_stays_within_its_noise) {
  Series data = rows_of(1000, 15.0);
  const std::vector<double> degC = read(data, degC_at);
  std::mt19937_64 random(5);
  for (const double sigma_K : {0.0, 0.002, 0.02}) {
    std::normal_distribution<double> noise;
    std::vector<double> fine = degC;
    for (double& value : fine) value += sigma_K * noise(random);
    data.columns = {{"T_degC", Role::structure, fine}};
    const LoggedInputs found = logged_inputs(data, {});
    EXPECT_LT(rms_difference(found.series.columns[0].values, fine), 1.1 * sigma_K + 1e-3) << sigma_K;
    EXPECT_LT(rms_difference(found.series.columns[0].values, degC), sigma_K + 1e-3) << sigma_K;
  }
}

// A door that opens: 1 K within two rows. What is drawn follows within a row or two.
TEST(LoggedInputs, a_fine_temperature_keeps_its_steps) {
  Series data = rows_of(400, 15.0);
  std::mt19937_64 random(5);
  std::normal_distribution<double> noise(0.0, 0.01);
  std::vector<double> degC = read(data, degC_at), read_degC = degC;
  for (std::size_t i = 0; i < 400; ++i) {
    if (i >= 200) degC[i] += 1.0;
    read_degC[i] = degC[i] + noise(random);
  }
  data.columns = {{"T_degC", Role::ambient, read_degC}};
  const LoggedInputs found = logged_inputs(data, {});
  const std::vector<double>& drawn = found.series.columns[0].values;
  EXPECT_LT(std::abs(drawn[196] - degC[196]), 0.2);
  EXPECT_LT(std::abs(drawn[203] - degC[203]), 0.2);
  EXPECT_LT(rms_difference(drawn, degC), 0.05);
}

// A body that begins to warm by 0.8 K a minute when the spindle starts. What is drawn bends there as the body does;
// without the speed it is rounder, or as rough as what was read.
TEST(LoggedInputs, a_temperature_bends_where_the_speed_changes) {
  Series data = rows_of(240, 60.0);
  std::mt19937_64 random(5);
  std::normal_distribution<double> noise(0.0, 0.03);
  std::vector<double> rpm, degC{21.0}, read_degC;
  for (std::size_t i = 0; i < 240; ++i) rpm.push_back(i >= 60 ? 8000.0 : 0.0);
  for (std::size_t i = 1; i < 240; ++i) degC.push_back(degC[i - 1] + (21.0 + rpm[i] * 1.5e-3 - degC[i - 1]) / 15.0);
  for (const double value : degC) read_degC.push_back(value + noise(random));
  data.columns = {{"T_degC", Role::structure, read_degC}};
  const double alone_K = rms_difference(logged_inputs(data, {}).series.columns[0].values, degC);
  data.columns.push_back({"speed_rpm", Role::speed, rpm});
  const double beside_K = rms_difference(logged_inputs(data, {}).series.columns[0].values, degC);
  EXPECT_LT(beside_K, 0.7 * alone_K);
  EXPECT_LT(beside_K, 0.6 * 0.03);
}

// Uneven rows have no sample; a coarse column is drawn through its runs all the same.
TEST(LoggedInputs, of_uneven_rows) {
  Series data;
  double now = 0.0;
  for (int i = 0; i < 800; ++i) data.time_s.push_back(now += i % 3 == 0 ? 10.0 : 25.0);
  const std::vector<double> degC = read(data, degC_at), exact = read(data, rpm_at);
  std::vector<double> coarse = degC;
  for (double& value : coarse) value = std::round(10.0 * value) / 10.0;
  data.columns = {{"T_degC", Role::structure, coarse}, {"n_rpm", Role::speed, exact}};
  const LoggedInputs found = logged_inputs(data, {});
  EXPECT_LT(rms_difference(found.series.columns[0].values, degC), 0.02);
  EXPECT_EQ(found.series.columns[1].values, exact);
  EXPECT_EQ(input(found, "n_rpm").jumps.size(), 10U);
}

// A load that is never at rest is no stepped input.
TEST(LoggedInputs, a_load_that_wanders_has_no_jumps) {
  Series data = rows_of(300, 15.0);
  std::mt19937_64 random(5);
  std::normal_distribution<double> noise(0.0, 100.0);
  Column load{"spindle_W", Role::load, {}};
  for (int i = 0; i < 300; ++i) load.values.push_back(500.0 + noise(random));
  data.columns = {load};
  const LoggedInputs found = logged_inputs(data, {});
  EXPECT_EQ(found.series.columns[0].values, load.values);
  EXPECT_TRUE(input(found, "spindle_W").jumps.empty());
  EXPECT_FALSE(input(found, "spindle_W").is_stepped);
}

void expect_untouched(const Series& data, const std::vector<std::string>& targets, const std::string& what) {
  const LoggedInputs found = logged_inputs(data, targets);
  ASSERT_EQ(found.series.columns.size(), data.columns.size()) << what;
  EXPECT_EQ(found.series.time_s, data.time_s) << what;
  for (std::size_t k = 0; k < data.columns.size(); ++k) {
    EXPECT_EQ(found.series.columns[k].name, data.columns[k].name) << what;
    ASSERT_EQ(found.series.columns[k].values.size(), data.columns[k].values.size()) << what;
    for (std::size_t i = 0; i < data.columns[k].values.size(); ++i) {
      const double a = found.series.columns[k].values[i], b = data.columns[k].values[i];
      EXPECT_TRUE(a == b || (std::isnan(a) && std::isnan(b))) << what << " " << i;
    }
  }
}

TEST(LoggedInputs, leaves_what_it_cannot_judge) {
  expect_untouched({}, {}, "nothing");
  Series none = rows_of(0, 15.0);
  none.columns = {{"T_degC", Role::structure, {}}, {"n_rpm", Role::speed, {}}};
  expect_untouched(none, {}, "no rows");
  Series five = rows_of(5, 15.0);
  five.columns = {{"T_degC", Role::structure, {1, 2, 1, 2, 1}}, {"n_rpm", Role::speed, {0, 0, 1000, 1000, 0}}};
  expect_untouched(five, {}, "5 rows");
  Series data = rows_of(200, 15.0);
  std::vector<double> coarse = read(data, degC_at), rpm = held(read(data, rpm_at), 4, 0);
  for (double& value : coarse) value = std::round(10.0 * value) / 10.0;
  std::vector<double> with_gaps = coarse, all_gaps(200, kNaN), rpm_with_gaps = rpm;
  for (std::size_t i = 0; i < 200; i += 3) with_gaps[i] = rpm_with_gaps[i] = kNaN;
  std::vector<double> one_gap = coarse;
  one_gap.back() = kNaN;
  data.columns = {{"T1_degC", Role::structure, with_gaps},
                  {"T2_degC", Role::structure, all_gaps},
                  {"T3_degC", Role::structure, one_gap},
                  {"T4_degC", Role::structure, std::vector<double>(200, 21.3)},
                  {"n1_rpm", Role::speed, rpm_with_gaps},
                  {"n2_rpm", Role::speed, all_gaps},
                  {"n3_rpm", Role::speed, std::vector<double>(200, 6000.0)},
                  {"T_target_degC", Role::structure, coarse},
                  {"z_um", Role::measured, coarse},
                  {"x_um", Role::measured, with_gaps}};
  expect_untouched(data, {"T_target_degC", "z_um"}, "gaps, constants, targets");
  // Readings of a ballbar over the angle are no log.
  data.columns = {{"angle_rad", Role::event, data.time_s}, {"n_rpm", Role::speed, rpm}};
  expect_untouched(data, {}, "recordings");
}

// At the first and at the last row, and at every row: no row before or behind is asked for.
TEST(LoggedInputs, changes_at_the_ends) {
  Series data = rows_of(40, 15.0);
  std::vector<double> first(40, 3000.0), last(40, 0.0), every(40);
  first[0] = 0.0;
  last[39] = 3000.0;
  for (std::size_t i = 0; i < 40; ++i) every[i] = i % 2 == 0 ? 0.0 : 3000.0;
  data.columns = {{"a_rpm", Role::speed, first}, {"b_rpm", Role::speed, last}, {"c_rpm", Role::speed, every}};
  const LoggedInputs found = logged_inputs(data, {});
  ASSERT_EQ(input(found, "a_rpm").jumps.size(), 1U);
  EXPECT_EQ(input(found, "a_rpm").jumps[0].first, 0U);
  ASSERT_EQ(input(found, "b_rpm").jumps.size(), 1U);
  EXPECT_EQ(input(found, "b_rpm").jumps[0].last, 39U);
  for (const Column& column : found.series.columns) {
    for (const double value : column.values) EXPECT_TRUE(value >= 0.0 && value <= 3000.0);
  }
}

// Steps of a millisecond and of a day.
TEST(LoggedInputs, of_any_step) {
  for (const double step_s : {0.001, 86400.0}) {
    Series data = rows_of(400, step_s);
    const Series seconds = rows_of(400, 15.0);
    std::vector<double> degC = read(seconds, degC_at), coarse = degC;
    for (double& value : coarse) value = std::round(10.0 * value) / 10.0;
    data.columns = {{"T_degC", Role::structure, coarse}, {"n_rpm", Role::speed, read(seconds, rpm_at)}};
    const LoggedInputs found = logged_inputs(data, {});
    EXPECT_LT(rms_difference(found.series.columns[0].values, degC), 0.02) << step_s;
    EXPECT_EQ(found.series.columns[1].values, data.columns[1].values) << step_s;
  }
}

}  // namespace
}  // namespace ballbar
