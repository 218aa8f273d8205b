// Logs in the conventions of strangers: what the values say counts, and what the diagnosis does not know it says.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "ballbar/diagnosis/signatures/search.hpp"
#include "ballbar/diagnosis/verdict/diagnose.hpp"
#include "ballbar/internal/series/sensor_jumps.hpp"
#include "diagnosis/outcome.hpp"
#include "effects/low_pass.hpp"

namespace ballbar {
namespace {

// A machine over 12 h in rows of 60 s: speed in blocks of an hour, a bearing that it warms, a room, a switch. Noise of
// z: 0.3 um.
struct Log {
  Series data;
  std::vector<double> bearing, room, on;
  std::mt19937_64 random{11};

  explicit Log(std::size_t n = 720, double step_s = 60.0) {
    std::vector<double> power;
    for (std::size_t i = 0; i < n; ++i) {
      data.time_s.push_back(step_s * static_cast<double>(i));
      const double hours = data.time_s.back() / 3600.0;
      const double speeds[] = {0.0, 6000.0, 2000.0, 9000.0, 0.0, 4000.0, 8000.0};
      const double speed = speeds[static_cast<std::size_t>(hours) % 7];
      speed_.push_back(speed);
      power.push_back(std::pow(speed / 9000.0, 1.6));
      room.push_back(20.0 + 1.5 * std::sin(0.37 * hours) + 0.4 * std::sin(1.9 * hours));
      on.push_back(std::fmod(hours, 2.6) > 1.4 ? 1.0 : 0.0);
    }
    bearing = behind(power, 2400.0);
    for (std::size_t i = 0; i < n; ++i) bearing[i] = room[i] + 25.0 * bearing[i];
    add("speed_rpm", Role::speed, speed_, 0.0);
    add("room_degC", Role::ambient, room, 0.01);
    add("bearing_degC", Role::bearing, bearing, 0.02);
  }

  std::vector<double> behind(const std::vector<double>& input, double tau_s) const {
    std::vector<double> out(input.size());
    low_pass<double>(
        data.time_s, [&](std::size_t i) { return input[i]; }, tau_s, out.data());
    return out;
  }

  double normal() { return std::normal_distribution<double>()(random); }

  void add(const std::string& name, Role role, std::vector<double> values, double noise) {
    for (double& value : values) value = noise > 0.0 ? std::round(100.0 * (value + noise * normal())) / 100.0 : value;
    data.columns.push_back({name, role, std::move(values)});
  }

  Diagnosis diagnosed(std::vector<double> z_um) {
    for (double& value : z_um) value = std::round(100.0 * (value + 0.3 * normal())) / 100.0;
    data.columns.push_back({"z_um", Role::measured, std::move(z_um)});
    Model constant;
    constant.targets = {"z_um"};
    return diagnose(constant, data);
  }

  std::vector<double> half_of_bearing() const {
    std::vector<double> z_um;
    for (const double value : bearing) z_um.push_back(0.5 * (value - bearing.front()));
    return z_um;
  }

 private:
  std::vector<double> speed_;
};

double p_of(const Diagnosis& found, const std::string& column) {
  for (const Driver& driver : found.drivers) {
    if (driver.column == column && driver.is_clear) return driver.p;
  }
  return 0.0;
}

std::vector<std::string> labels(const std::vector<BoundEffect>& bounds) {
  std::vector<std::string> names;
  for (const BoundEffect& bound : bounds) names.push_back(label_of(bound));
  return names;
}

// The true driver has no unit.
TEST(StrangersLog, a_column_without_a_unit_can_drive) {
  Log log;
  std::vector<double> bed = log.behind(log.on, 1500.0), z_um = bed;
  for (double& value : bed) value = 400.0 + 60.0 * value;
  log.add("bed", Role::event, bed, 0.05);
  for (double& value : z_um) value *= 12.0;
  const Diagnosis found = log.diagnosed(z_um);
  EXPECT_EQ(labels(found.named), std::vector<std::string>{"follows(bed)"}) << made::outcome_of(found);
  EXPECT_EQ(found.p_discrepancy < 0.5, true) << made::outcome_of(found);
}

// On and off, with a first-order body, beside a temperature.
TEST(StrangersLog, a_switch_is_exact) {
  Log log;
  log.add("coolant_on", Role::event, log.on, 0.0);
  std::vector<double> z_um = log.half_of_bearing();
  const std::vector<double> body = log.behind(log.on, 1200.0);
  for (std::size_t i = 0; i < z_um.size(); ++i) z_um[i] -= 6.0 * body[i];
  const Diagnosis found = log.diagnosed(z_um);
  EXPECT_GE(p_of(found, "coolant_on"), 0.95) << made::outcome_of(found);
  EXPECT_GE(p_of(found, "bearing_degC"), 0.95) << made::outcome_of(found);
  EXPECT_EQ(p_of(found, "room_degC"), 0.0) << made::outcome_of(found);
}

// A slow driver that nobody logged is no noise: 3 um, an hour and a half.
TEST(StrangersLog, an_unlogged_driver_is_a_slow_drift_without_a_cause) {
  Log log;
  std::vector<double> z_um = log.half_of_bearing();
  double first = 0.0, second = 0.0;
  for (double& value : z_um) {
    first += -first / 90.0 + std::sqrt(2.0 / 90.0) * log.normal();
    second += (first - second) / 30.0;
    value += 4.0 * second;
  }
  const Diagnosis found = log.diagnosed(z_um);
  EXPECT_NE(found.verdict, Verdict::nothing) << made::outcome_of(found);
  EXPECT_GE(found.p_discrepancy, 0.9) << made::outcome_of(found);
  EXPECT_GT(found.discrepancy_um, 1.0);
  EXPECT_LT(found.noise.white_um, 0.5);
  // Beside it the form of an effect is open.
  EXPECT_TRUE(found.named.empty()) << made::outcome_of(found);
}

// Some readings 300 um off.
TEST(StrangersLog, a_few_readings_far_off_are_set_aside) {
  Log log;
  std::vector<double> z_um = log.half_of_bearing();
  for (const std::size_t row : {40, 41, 200, 377, 500, 640}) z_um[row] += 300.0;
  const Diagnosis found = log.diagnosed(z_um);
  EXPECT_EQ(found.set_aside, 6U);
  EXPECT_LT(found.noise.white_um, 0.5);
  EXPECT_LT(found.rmse_after_um, 0.4);
  EXPECT_LT(found.base.floor.rms_um, 0.5);
  EXPECT_GE(p_of(found, "bearing_degC"), 0.95) << made::outcome_of(found);
}

// The control moves the target to and fro.
TEST(StrangersLog, jumps_of_the_target_are_no_effects) {
  Log log;
  std::vector<double> z_um = log.half_of_bearing();
  double level = 0.0;
  for (std::size_t i = 0; i < z_um.size(); ++i) {
    if (i % 37 == 20) level += i % 2 == 0 ? 2.5 : -2.5;
    z_um[i] += level;
  }
  const Diagnosis found = log.diagnosed(z_um);
  EXPECT_GE(found.level_jumps, 12U);
  EXPECT_NEAR(found.level_jump_um, 2.5, 0.6);
  EXPECT_NE(found.verdict, Verdict::nothing) << made::outcome_of(found);
  for (const Candidate& one : found.candidates) EXPECT_NE(one.bound.effect->name, "step");
}

// A sensor stops at the end of its range.
TEST(StrangersLog, rows_of_a_saturated_sensor_are_set_aside) {
  Log log;
  std::vector<double>& logged = log.data.columns.back().values;
  for (double& value : logged) value = std::min(value, 27.0);
  const Diagnosis found = log.diagnosed(log.half_of_bearing());
  ASSERT_EQ(found.saturated.size(), 1U) << made::outcome_of(found);
  EXPECT_EQ(found.saturated[0].column, "bearing_degC");
  EXPECT_GE(p_of(found, "bearing_degC"), 0.95) << made::outcome_of(found);
  EXPECT_EQ(p_of(found, "speed_rpm"), 0.0) << made::outcome_of(found);
}

// A sensor stands still for three hours and a half, then works again.
TEST(StrangersLog, rows_of_a_stuck_sensor_are_set_aside) {
  Log log;
  std::vector<double>&logged = log.data.columns[1].values, z_um = log.room;
  for (std::size_t i = 0; i < logged.size(); ++i)
    logged[i] = std::round(20.0 * (log.room[i] + 0.05 * log.normal())) / 20.0;
  std::fill(logged.begin() + 200, logged.begin() + 410, logged[200]);
  for (double& value : z_um) value *= 3.0;
  const Diagnosis found = log.diagnosed(z_um);
  ASSERT_EQ(found.saturated.size(), 1U) << made::outcome_of(found);
  EXPECT_EQ(found.saturated[0].column, "room_degC");
  EXPECT_TRUE(found.saturated[0].is_stuck);
  EXPECT_NEAR(found.saturated[0].share, 210.0 / 720.0, 0.01);
  EXPECT_GE(p_of(found, "room_degC"), 0.95) << made::outcome_of(found);
  EXPECT_EQ(p_of(found, "speed_rpm"), 0.0) << made::outcome_of(found);
}

// Contacts spark: one reading in 25 is off by some kelvins, most by less than any rule for single values finds.
TEST(StrangersLog, readings_of_a_poor_contact_choose_no_other_cause) {
  Log log;
  std::vector<double>& logged = log.data.columns.back().values;
  for (std::size_t i = 7; i < logged.size(); i += 25)
    logged[i] += (i % 2 == 0 ? 1.0 : -0.6) * (0.3 + 0.05 * static_cast<double>(i % 50));
  const Diagnosis found = log.diagnosed(log.half_of_bearing());
  EXPECT_GE(p_of(found, "bearing_degC"), 0.95) << made::outcome_of(found);
  EXPECT_EQ(p_of(found, "speed_rpm"), 0.0) << made::outcome_of(found);
}

// The sensor of the bearing is calibrated at noon.
TEST(StrangersLog, a_jump_of_the_zero_of_a_sensor_is_taken_out) {
  Log log;
  std::vector<double>& logged = log.data.columns.back().values;
  for (std::size_t i = 287; i < logged.size(); ++i) logged[i] += 1.5;
  log.data = *without_sensor_jumps(std::make_shared<const Series>(log.data));
  const Diagnosis found = log.diagnosed(log.half_of_bearing());
  ASSERT_EQ(found.sensor_jumps.size(), 1U) << made::outcome_of(found);
  EXPECT_EQ(found.sensor_jumps[0].column, "bearing_degC");
  EXPECT_EQ(found.sensor_jumps[0].time_s, 287.0 * 60.0);
  EXPECT_NEAR(found.sensor_jumps[0].size, 1.5, 0.05);
  EXPECT_GE(p_of(found, "bearing_degC"), 0.95) << made::outcome_of(found);
  EXPECT_EQ(p_of(found, "speed_rpm"), 0.0) << made::outcome_of(found);
}

// The sensor of the bearing is stuck for an hour: what it does at its end is no calibration.
TEST(StrangersLog, the_return_of_a_stuck_sensor_is_no_jump_of_its_zero) {
  Log log;
  std::vector<double>& logged = log.data.columns.back().values;
  for (std::size_t i = 200; i < 260; ++i) logged[i] = logged[200];
  const auto data = std::make_shared<const Series>(log.data);
  EXPECT_EQ(without_sensor_jumps(data), data);
}

// The log begins on a warm machine: a body with a lag is elsewhere than its temperature says.
TEST(StrangersLog, a_warm_start_is_no_step) {
  for (const std::size_t first : {100U, 150U, 200U}) {
    Log log(720);
    std::vector<double> z = log.behind(log.bearing, 600.0);
    for (double& value : z) value = 0.8 * value + 0.2 * log.normal();
    log.data.columns.push_back({"z_um", Role::measured, z});
    const Series late = rows_of(log.data, {first, 720});
    Model model;
    model.targets = {"z_um"};
    const Diagnosis found = diagnose(model, late);
    for (const BoundEffect& one : found.named) EXPECT_NE(one.effect->name, "step") << made::outcome_of(found);
    EXPECT_GE(p_of(found, "bearing_degC"), 0.95) << made::outcome_of(found);
  }
}

// A display in whole kelvins. The speed imitates the bearing to less than that.
TEST(StrangersLog, beside_a_coarse_column_that_may_be_the_cause_nothing_is_certain) {
  Log log;
  for (double& value : log.data.columns.back().values) value = std::round(value);
  const Diagnosis found = log.diagnosed(log.half_of_bearing());
  for (const BoundEffect& one : found.named) EXPECT_EQ(one.columns, std::vector<std::string>{"bearing_degC"});
  const bool is_read = std::any_of(found.candidates.begin(), found.candidates.end(), [](const Candidate& one) {
    return one.in_best_set && one.bound.columns == std::vector<std::string>{"bearing_degC"};
  });
  if (is_read) return;
  ASSERT_EQ(found.coarse_columns.size(), 1U) << made::outcome_of(found);
  EXPECT_EQ(found.coarse_columns[0].column, "bearing_degC");
  EXPECT_EQ(found.coarse_columns[0].resolution, 1.0);
  EXPECT_TRUE(found.named.empty()) << made::outcome_of(found);
  for (const Driver& driver : found.drivers) EXPECT_FALSE(driver.is_clear) << driver.column;
}

// Two sensors in one place: their noise does not choose between them.
TEST(StrangersLog, of_two_sensors_that_read_one_quantity_neither_is_certain) {
  Log log;
  std::vector<double> other = log.bearing;
  for (double& value : other) value += 0.35;
  log.add("bearing_2_degC", Role::bearing, other, 0.02);
  const Diagnosis found = log.diagnosed(log.half_of_bearing());
  ASSERT_EQ(found.equal_columns.size(), 1U) << made::outcome_of(found);
  EXPECT_EQ(found.equal_columns[0], (EqualColumns{"bearing_degC", "bearing_2_degC"}));
  EXPECT_EQ(found.verdict, Verdict::equivalent) << made::outcome_of(found);
  ASSERT_EQ(found.equivalent.size(), 1U);
  EXPECT_EQ(found.equivalent[0].size(), 2U) << made::outcome_of(found);
  EXPECT_NEAR(p_of(found, "bearing_degC"), 0.5, 0.05) << made::outcome_of(found);
  EXPECT_NEAR(p_of(found, "bearing_2_degC"), 0.5, 0.05) << made::outcome_of(found);
}

// One of three reads twice as fast: two are in one place.
TEST(StrangersLog, a_sensor_of_another_body_is_not_one_of_them) {
  Log log;
  std::vector<double> other = log.bearing, motor = log.behind(log.bearing, 400.0);
  for (double& value : other) value -= 0.2;
  log.add("bearing_2_degC", Role::bearing, other, 0.02);
  log.add("motor_degC", Role::bearing, motor, 0.02);
  const Diagnosis found = log.diagnosed(log.half_of_bearing());
  ASSERT_EQ(found.equal_columns.size(), 1U) << made::outcome_of(found);
  EXPECT_EQ(found.equal_columns[0], (EqualColumns{"bearing_degC", "bearing_2_degC"}));
}

// The noise of a poor sensor is no reason to read the good one less.
TEST(StrangersLog, the_mean_of_two_sensors_weighs_their_noise) {
  Log log;
  log.add("bearing_2_degC", Role::bearing, log.bearing, 0.9);
  const Diagnosis found = log.diagnosed(log.half_of_bearing());
  ASSERT_EQ(found.equal_columns.size(), 1U) << made::outcome_of(found);
  Log alone;
  const Diagnosis good = alone.diagnosed(alone.half_of_bearing());
  EXPECT_LT(found.rmse_after_um, 1.05 * good.rmse_after_um);
}

// Nothing is certain beside a column that could not be searched.
TEST(StrangersLog, nothing_is_named_beside_a_column_with_gaps) {
  Log log;
  log.add("door", Role::event, log.on, 0.0);
  log.data.columns.back().values[3] = std::nan("");
  const Diagnosis found = log.diagnosed(log.half_of_bearing());
  ASSERT_EQ(found.columns_not_searched.size(), 1U) << made::outcome_of(found);
  EXPECT_EQ(found.columns_not_searched[0].column, "door");
  EXPECT_TRUE(found.named.empty()) << made::outcome_of(found);
  EXPECT_EQ(p_of(found, "bearing_degC"), 0.0) << made::outcome_of(found);
  EXPECT_TRUE(found.columns_not_searched[0].has_gaps);
}

// The set-up gives way by 1.5 um and comes back within minutes, as noise does: no step.
TEST(StrangersLog, a_change_that_the_noise_forgets_is_no_step) {
  const auto with = [](double lasts_s) {
    Log log;
    std::vector<double> z_um;
    double slow_um = 0.0;
    for (std::size_t i = 0; i < log.data.time_s.size(); ++i) {
      slow_um = 0.92 * slow_um + 0.3 * log.normal();
      const double since_s = log.data.time_s[i] - 20000.0;
      z_um.push_back(slow_um + (since_s >= 0.0 ? 4.0 * std::exp(-since_s / lasts_s) : 0.0));
    }
    return log.diagnosed(z_um);
  };
  for (const BoundEffect& one : with(900.0).named) EXPECT_NE(one.effect->name, "step");
  EXPECT_EQ(labels(with(1e9).named), std::vector<std::string>{"step"});
}

// Read by hand every 20 min: two temperatures, and least squares over all subsets of two agrees.
TEST(StrangersLog, a_few_rows_by_hand_are_enough_for_two_columns) {
  Log log(40, 1200.0);
  std::vector<double> z_um = log.half_of_bearing();
  for (std::size_t i = 0; i < z_um.size(); ++i) z_um[i] += 1.5 * (log.room[i] - log.room.front());
  const Diagnosis found = log.diagnosed(z_um);
  EXPECT_GE(p_of(found, "bearing_degC"), 0.9) << made::outcome_of(found);
  EXPECT_GE(p_of(found, "room_degC"), 0.9) << made::outcome_of(found);
  EXPECT_EQ(p_of(found, "speed_rpm"), 0.0) << made::outcome_of(found);
}

// Read by hand every hour, more rows, two temperatures that go together: no row is smoothed, and none is an hour late.
TEST(StrangersLog, rows_of_an_hour_tell_two_columns_that_go_together) {
  Log log(70, 3600.0);
  std::vector<double> frame;
  for (std::size_t i = 0; i < log.room.size(); ++i)
    frame.push_back(0.5 * (log.bearing[i] + log.room[i]) + 0.8 * std::sin(0.31 * static_cast<double>(i)));
  log.add("frame_degC", Role::structure, frame, 0.05);
  std::vector<double> z_um = log.half_of_bearing();
  for (std::size_t i = 0; i < z_um.size(); ++i) z_um[i] += 0.8 * (frame[i] - frame.front());
  const Diagnosis found = log.diagnosed(z_um);
  EXPECT_GE(p_of(found, "bearing_degC"), 0.9) << made::outcome_of(found);
  EXPECT_GE(p_of(found, "frame_degC"), 0.9) << made::outcome_of(found);
}

// An exponent between those of the catalogue is no other effect: heat that decays at another rate than it builds up is
// less likely, but not excluded.
TEST(StrangersLog, an_exponent_lies_between_those_of_the_catalogue) {
  Log log;
  std::vector<double> power;
  for (const double speed : log.data.columns.front().values) power.push_back(std::pow(speed / 1000.0, 1.35));
  std::vector<double> z_um = log.behind(power, 3600.0);
  const Diagnosis found = log.diagnosed(z_um);
  std::vector<BoundEffect> said = found.named;
  said.insert(said.end(), found.probable.begin(), found.probable.end());
  ASSERT_EQ(labels(said), std::vector<std::string>{"speed_heating(speed_rpm)"}) << made::outcome_of(found);
  EXPECT_NEAR(found.candidates.front().parameters.back().value, 1.35, 0.1);
}

// Beside a motor that is nearly the speed behind a lag, but not quite: the speed alone explains z to the noise, at an
// exponent and a time constant between those of the grid.
TEST(StrangersLog, an_exact_shape_wins_over_a_temperature_that_imitates_it) {
  Log log(241, 60.0);
  std::vector<double> heat, power;
  for (const double speed : log.data.columns.front().values) {
    heat.push_back(25.0 * std::pow(speed / 8000.0, 1.3));
    power.push_back(12.0 * std::pow(speed / 8000.0, 1.55));
  }
  std::vector<double> motor = log.behind(heat, 2400.0);
  for (std::size_t i = 0; i < motor.size(); ++i) motor[i] += log.room[i];
  log.add("motor_degC", Role::structure, motor, 0.0);
  const Diagnosis found = log.diagnosed(log.behind(power, 3000.0));
  std::vector<BoundEffect> said = found.named;
  said.insert(said.end(), found.probable.begin(), found.probable.end());
  for (const std::string& label : labels(said)) EXPECT_EQ(label, "speed_heating(speed_rpm)") << made::outcome_of(found);
  EXPECT_GT(p_of(found, "speed_rpm"), 0.8) << made::outcome_of(found);
}

// The readings state their sigma: a remaining error of several times as much is not nothing.
TEST(StrangersLog, an_error_above_the_stated_sigma_is_not_nothing) {
  Log log;
  log.add("z_sigma_um", Role::measured, std::vector<double>(log.room.size(), 0.02), 0.0);
  const Diagnosis found = log.diagnosed(std::vector<double>(log.room.size(), 0.0));
  EXPECT_EQ(found.verdict, Verdict::unexplained) << made::outcome_of(found);
  EXPECT_GE(found.p_nothing, kNothing);
  EXPECT_GT(found.base.rmse_um, 3.0 * 0.02);
}

// A person reads every 10 min, each value at its moment: nothing delays it, so a lag of 15 min is no sampling.
TEST(StrangersLog, rows_read_by_hand_show_a_short_lag) {
  Log log(72, 600.0);
  log.data.columns.clear();
  std::vector<double> motor, z_um;
  for (const double time_s : log.data.time_s) {
    const double hours = time_s / 3600.0;
    motor.push_back(25.0 + 8.0 * std::sin(0.9 * hours) + 3.0 * std::sin(2.3 * hours));
  }
  log.add("motor_degC", Role::structure, motor, 0.02);
  for (const double value : log.behind(motor, 900.0)) z_um.push_back(0.9 * (value - motor.front()));
  const Diagnosis found = log.diagnosed(std::move(z_um));
  ASSERT_EQ(labels(found.named), std::vector<std::string>{"lagged_expansion(motor_degC)"}) << made::outcome_of(found);
  EXPECT_NEAR(candidate_of(found, found.named.front())->parameters[1].value, 900.0, 150.0);
}

// A body that a recursion over the rows computes from the mean of the hour, as a logger stamps it at its end: half a
// row early. A share of the room at once would make up for it, but is no effect.
TEST(StrangersLog, hourly_means_are_no_second_effect) {
  constexpr double kTau_rows = 5.0, kGain = 8.0;
  Log log(240, 3600.0);
  log.data.columns.resize(2);
  log.data.columns.erase(log.data.columns.begin());
  std::vector<double> z_um;
  double body = log.room.front();
  for (const double room : log.room) {
    body += (1.0 - std::exp(-1.0 / kTau_rows)) * (room - body);
    z_um.push_back(kGain * (body - log.room.front()));
  }
  const Diagnosis found = log.diagnosed(std::move(z_um));
  ASSERT_EQ(labels(found.named), std::vector<std::string>{"lagged_expansion(room_degC)"}) << made::outcome_of(found);
  for (const Candidate& one : found.candidates) {
    if (one.in_best_set && one.bound.effect->name == "expansion") {
      EXPECT_FALSE(one.doubts.empty());
    }
  }
}

// What is left out because it holds words was not looked at.
TEST(StrangersLog, nothing_is_certain_beside_states_in_words) {
  Log log;
  EXPECT_EQ(log.diagnosed(log.half_of_bearing()).verdict, Verdict::named);
  Log with_states;
  with_states.data.unread = {"Program"};
  const Diagnosis found = with_states.diagnosed(with_states.half_of_bearing());
  EXPECT_EQ(found.verdict, Verdict::probable) << made::outcome_of(found);
  ASSERT_EQ(found.columns_not_searched.size(), 1U);
  EXPECT_EQ(found.columns_not_searched.front().column, "Program");
  EXPECT_TRUE(found.columns_not_searched.front().is_words);
}

}  // namespace
}  // namespace ballbar
