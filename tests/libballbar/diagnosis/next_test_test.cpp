#include "ballbar/diagnosis/next_test/next_test.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/QR>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "ballbar/circle/trace.hpp"
#include "diagnosis/next_test/discrimination.hpp"
#include "diagnosis/next_test/planned_test.hpp"
#include "diagnosis/next_test/thermal_forecast.hpp"
#include "effects/low_pass.hpp"

namespace ballbar {
namespace {

constexpr double kPi = std::numbers::pi;

std::vector<double> low_passed(const std::vector<double>& time_s, const std::vector<double>& drive, double tau_s) {
  std::vector<double> out(drive.size());
  low_pass(
      time_s, [&](std::size_t i) { return drive[i]; }, tau_s, out.data());
  return out;
}

// Rows of 60 s. The housing warms 0.4 K for each krpm^2 with 40 min, and follows the room with an hour.
Series machine(std::size_t n, double (*rpm_at)(double hours), double (*room_at)(double hours)) {
  Series data;
  Column speed{"speed_rpm", Role::speed, {}}, room{"T_room_degC", Role::ambient, {}},
      housing{"T_housing_degC", Role::housing, {}};
  std::vector<double> heat;
  for (std::size_t i = 0; i < n; ++i) {
    const double hours = static_cast<double>(i) / 60.0;
    data.time_s.push_back(3600.0 * hours);
    speed.values.push_back(rpm_at(hours));
    room.values.push_back(room_at(hours));
    heat.push_back(0.4 * std::pow(speed.values.back() / 1000.0, 2));
  }
  const std::vector<double> warm = low_passed(data.time_s, heat, 2400.0);
  const std::vector<double> ambient = low_passed(data.time_s, room.values, 3600.0);
  for (std::size_t i = 0; i < n; ++i) housing.values.push_back(warm[i] + ambient[i]);
  data.columns = {speed, room, housing};
  return data;
}

double start_and_stop(double hours) {
  if (std::fmod(hours, 3.0) >= 1.5 || hours == 0.0) return 0.0;
  return hours < 3.0 ? 5000.0 : 3000.0;
}
double start_once(double hours) { return hours > 0.0 ? 5000.0 : 0.0; }
double wandering_room(double hours) { return 20.0 + std::sin(hours / 0.9); }
double rising_room(double hours) { return 20.0 + 0.2 * hours; }

std::vector<double> values_of(const Term& term, const std::vector<double>& parameters, const Series& data) {
  EffectRows rows{data.time_s, {}};
  for (const std::string& name : term.columns) rows.inputs.emplace_back(find_column(data, name)->values);
  std::vector<double> values(data.time_s.size());
  term.effect->evaluate(rows, parameters.data(), values.data(), nullptr);
  return values;
}

void add_target(Series& data, std::vector<double> values, double sigma_um, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> noise(0.0, sigma_um);
  for (double& value : values) value += noise(random);
  data.columns.push_back({"z_um", Role::measured, std::move(values)});
}

Model empty_model() {
  Model model;
  model.targets = {"z_um"};
  return model;
}

// The competitors fitted alone, all of them equivalent, the likeliest first.
Diagnosis undecided(const Model& model, const Series& data, const std::vector<Term>& competitors) {
  Diagnosis diagnosis;
  diagnosis.target = model.targets[0];
  diagnosis.base = fit(model, data);
  diagnosis.verdict = Verdict::equivalent;
  diagnosis.equivalent.emplace_back();
  double least_um = 0.0;
  for (const Term& competitor : competitors) {
    Model with = model;
    with.terms.push_back(competitor);
    const Fit fitted = fit(with, data);
    Candidate candidate;
    candidate.bound = {find_effect(competitor.effect->name, model.level), competitor.columns};
    const auto count = static_cast<std::ptrdiff_t>(competitor.settings.size());
    candidate.parameters = {fitted.parameters.end() - count, fitted.parameters.end()};
    candidate.rmse_after_um = fitted.rmse_um;
    candidate.p = 1.0 / fitted.rmse_um;  // no probability, but the order of one
    if (diagnosis.candidates.empty() || fitted.rmse_um < least_um) {
      least_um = fitted.rmse_um;
      diagnosis.noise = fitted.noise;
    }
    diagnosis.equivalent[0].push_back(candidate.bound);
    diagnosis.candidates.push_back(std::move(candidate));
  }
  std::stable_sort(diagnosis.candidates.begin(), diagnosis.candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.rmse_after_um < b.rmse_after_um; });
  if (!diagnosis.candidates.empty()) diagnosis.candidates[0].in_best_set = true;
  return diagnosis;
}

const NextTest& named(const std::vector<NextTest>& tests, const std::string& name) {
  const auto found = std::find_if(tests.begin(), tests.end(), [&](const NextTest& test) { return test.name == name; });
  EXPECT_NE(found, tests.end()) << name;
  return found == tests.end() ? tests.front() : *found;
}

// Two readings of the data, two of a test, white noise of 0.5 um. Columns: constant of the data, of the test, signal A
// (0, 1 | 0, 1), signal B (0, 1 | 0, -1). Freed of the constants A = (-1, 1 | -1, 1) / 2 and B = (-1, 1 | 1, -1) / 2:
// in the data they are the same, with the test orthogonal. Then |A| = 1 um, over 0.5 um: d = 2.
TEST(next_test, d_by_hand) {
  Noise noise;
  noise.white_um = 0.5;
  const std::vector<double> time_s{0.0, 60.0};
  const Whitening whitening(noise, time_s, {});
  Eigen::MatrixXd data(2, 4), test(2, 4);
  data << 1, 0, 0, 0, 1, 0, 1, 1;
  test << 0, 1, 0, 0, 0, 1, 1, -1;
  const Eigen::MatrixXd first = whitened_factor(data, whitening);
  EXPECT_NEAR(distance(first, 2, {0, 1, 3}), 0.0, 1e-12);
  EXPECT_NEAR(distance(first, 2, {0, 1}), std::sqrt(0.5) / 0.5, 1e-12);
  const Eigen::MatrixXd together = both(first, test, whitening);
  EXPECT_NEAR(distance(together, 2, {0, 1, 3}), 2.0, 1e-12);
  EXPECT_NEAR(distance(together, 3, {0, 1, 2}), 2.0, 1e-12);
}

// A column that is 20 + 0.4 LP_2400[n^2] + LP_3600[room], with time constants that are not on the grid.
TEST(next_test, a_column_follows_speed_and_room_as_it_did) {
  const Series data = machine(8 * 60, start_and_stop, wandering_room);
  const Series later = machine(
      4 * 60, [](double hours) { return hours > 1.0 ? 4000.0 : 0.0; }, rising_room);
  const auto drives = [](const Series& series) {
    return Drives{series.time_s, series.columns[0].values, series.columns[1].values, {}};
  };
  std::vector<double> random;
  std::mt19937_64 generator(1);
  for (std::size_t i = 0; i < data.time_s.size(); ++i) random.push_back(std::normal_distribution<double>()(generator));
  const std::vector<double> constant(data.time_s.size(), 21.0);
  const std::vector<Forecast> forecasts = forecasts_of(drives(data), {data.columns[2].values, random, constant});
  EXPECT_GT(forecasts[0].r2, 0.99);
  EXPECT_LT(forecasts[1].r2, 0.2);
  EXPECT_EQ(forecasts[2].r2, 1.0);
  const std::vector<double> found = predicted(forecasts[0], drives(later));
  double largest = 0.0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    largest = std::max(largest, std::abs(found[i] - later.columns[2].values[i]));
  }

  EXPECT_LT(largest, 0.5);  // of 6.8 K
  EXPECT_NEAR(predicted(forecasts[2], drives(later)).back(), 21.0, 1e-9);
}

// A start that is not followed by a stop: the housing warms as the mount settles.
TEST(next_test, settling_does_not_come_back_where_a_lag_does) {
  Series data = machine(4 * 60, start_once, wandering_room);
  add_target(data, values_of(term_of("settling", {}), {10.0, 3000.0}, data), 0.3, 1);
  const Diagnosis diagnosis =
      undecided(empty_model(), data, {term_of("settling", {}), term_of("lagged_expansion", {"T_housing_degC"})});
  const std::vector<NextTest> tests = next_tests(empty_model(), data, diagnosis);
  ASSERT_FALSE(tests.empty());
  const NextTest& again = named(tests, "the same again");
  EXPECT_GT(again.separation, 20.0);
  EXPECT_GT(again.separation, 0.5 * tests.front().separation);
  EXPECT_GT(again.separation, 2.0 * named(tests, "new set-up").separation);
}

TEST(next_test, a_room_step_tells_the_room_from_the_instrument) {
  Series data = machine(6 * 60, start_and_stop, rising_room);
  const Term truth = term_of("lagged_expansion", {"T_room_degC"});
  add_target(data, values_of(truth, {5.0, 3600.0}, data), 0.3, 2);
  const std::vector<Term> competitors{truth, term_of("linear_drift", {})};
  const std::vector<NextTest> tests = next_tests(empty_model(), data, undecided(empty_model(), data, competitors));
  ASSERT_FALSE(tests.empty());
  EXPECT_EQ(tests.front().name.substr(0, 9), "room step");
}

Series circles(bool both_ways, double squareness_um_per_m, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> noise(0.0, 0.3);
  std::vector<Recording> recordings;
  for (int k = 0; k < (both_ways ? 2 : 1); ++k) {
    Recording recording;
    recording.direction = k == 0 ? Direction::CCW : Direction::CW;
    recording.nominal_length_mm = 100.0;
    recording.feed_mm_per_min = 1000.0;
    for (int i = 0; i < 360; ++i) {
      const double angle = (k == 0 ? 1.0 : -1.0) * (i + 0.5) * kPi / 180.0;
      recording.angle_rad.push_back(angle);
      const double um = 3.0 * std::cos(angle) - 0.05 * squareness_um_per_m * std::sin(2.0 * angle) + noise(random);
      recording.length_mm.push_back(100.0 + 1e-3 * um);
    }
    recordings.push_back(std::move(recording));
  }
  return trace_of(recordings);
}

Model circle_model() {
  Model model;
  model.level = Level::recording;
  model.targets = {"deviation_um"};
  model.terms = {term_of("circle", {"angle_rad", "radius_mm", "height_mm", "recording"}, Level::recording)};
  return model;
}

TEST(next_test, one_direction_asks_for_the_other) {
  const Series trace = circles(false, 20.0, 3);
  const std::vector<Term> competitors{
      term_of("squareness", {"angle_rad", "radius_mm"}, Level::recording),
      term_of("servo_mismatch", {"angle_rad", "direction", "feed_mm_per_min"}, Level::recording)};
  const std::vector<NextTest> tests = next_tests(circle_model(), trace, undecided(circle_model(), trace, competitors));
  ASSERT_FALSE(tests.empty());
  EXPECT_EQ(tests.front().name, "the other direction");
  // sin 2 theta of 1 um over 0.3 um: |g| = sqrt(360 / 2) / 0.3 = 44.7 in each sweep. Same and opposite sign: nothing of
  // it can be imitated in both, d = sqrt(2) 44.7 = 63. Twice the feed: (1, 1) against (1, 2), sine sqrt(1 / 10): 20.
  EXPECT_NEAR(tests.front().separation, 63.2, 8.0);
  EXPECT_NEAR(named(tests, "twice the feed").separation, 20.0, 3.0);
  EXPECT_NEAR(tests.front().separation_so_far, 0.0, 1e-3);
  EXPECT_NEAR(named(tests, "the same again").separation, 0.0, 1e-3);
}

TEST(next_test, both_directions_are_not_asked_again) {
  const Series trace = circles(true, 20.0, 4);
  const std::vector<Term> competitors{
      term_of("squareness", {"angle_rad", "radius_mm"}, Level::recording),
      term_of("servo_mismatch", {"angle_rad", "direction", "feed_mm_per_min"}, Level::recording)};
  for (const NextTest& one : next_tests(circle_model(), trace, undecided(circle_model(), trace, competitors))) {
    EXPECT_NE(one.name, "the other direction");
  }
}

// chi^2 of the target by constants of both runs and the term, its first shape searched over a fine grid.
double chi2(const Term& term, const std::vector<const Series*>& runs, double sigma_um) {
  Eigen::Index n = 0;
  for (const Series* run : runs) n += static_cast<Eigen::Index>(run->time_s.size());
  double least = std::numeric_limits<double>::infinity();
  const bool has_shape = term.effect->parameters.size() > 1;
  for (double tau_s = 60.0; tau_s < 1e5; tau_s *= 1.05) {
    Eigen::MatrixXd x = Eigen::MatrixXd::Zero(n, 3);
    Eigen::VectorXd y(n);
    Eigen::Index row = 0;
    for (std::size_t r = 0; r < runs.size(); ++r) {
      std::vector<double> parameters{1.0};
      if (has_shape) parameters.push_back(tau_s);
      while (parameters.size() < term.effect->parameters.size()) {
        parameters.push_back(term.effect->parameters[parameters.size()].start);
      }
      const std::vector<double> values = values_of(term, parameters, *runs[r]);
      const std::vector<double>& target = find_column(*runs[r], "z_um")->values;
      for (std::size_t i = 0; i < values.size(); ++i, ++row) {
        x(row, static_cast<Eigen::Index>(r)) = 1.0;
        x(row, 2) = values[i];
        y[row] = target[i];
      }
    }
    least = std::min(least, (y - x * x.colPivHouseholderQr().solve(y)).squaredNorm());
    if (!has_shape) break;
  }
  return least / (sigma_um * sigma_um);
}

// Data and test are simulated from the truth, with the housing that the machine would really have; the competitors are
// fitted to both by an exhaustive search. d scatters by 1.
TEST(next_test, what_is_promised_comes_true) {
  constexpr double kSigma_um = 0.3;
  const std::vector<Term> competitors{term_of("lagged_expansion", {"T_housing_degC"}),
                                      term_of("speed_heating", {"speed_rpm"})};
  Series data = machine(6 * 60, start_and_stop, wandering_room);
  const std::vector<double> truth{1.5, 1500.0};
  add_target(data, values_of(competitors[0], truth, data), kSigma_um, 5);
  const std::vector<NextTest> tests = next_tests(empty_model(), data, undecided(empty_model(), data, competitors));
  ASSERT_FALSE(tests.empty());
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < data.time_s.size(); ++i) rows.push_back(i);
  std::size_t compared = 0;
  for (const PlannedTest& plan : drift_tests(data, "z_um", rows)) {
    if (plan.name == "new set-up") continue;
    Series after = plan.inputs;
    const std::vector<double>& rpm = after.columns[0].values;
    std::vector<double> heat;
    for (const double value : rpm) heat.push_back(0.4 * std::pow(value / 1000.0, 2));
    const std::vector<double> warm = low_passed(after.time_s, heat, 2400.0);
    const std::vector<double> ambient = low_passed(after.time_s, after.columns[1].values, 3600.0);
    for (std::size_t i = 0; i < warm.size(); ++i) after.columns[2].values[i] = warm[i] + ambient[i];
    add_target(after, values_of(competitors[0], truth, after), kSigma_um, 6);
    const double realised = std::sqrt(std::max(
        0.0, chi2(competitors[1], {&data, &after}, kSigma_um) - chi2(competitors[0], {&data, &after}, kSigma_um)));
    const double promised = named(tests, plan.name).separation;
    ++compared;
    EXPECT_LT(realised, 1.5 * promised) << plan.name;
    EXPECT_GT(realised, promised / 1.5) << plan.name;
  }
  EXPECT_GT(compared, 6u);
}

TEST(next_test, of_time_alone_asks_whether_it_comes_again) {
  Series data = machine(4 * 60, start_and_stop, wandering_room);
  const Term settling = term_of("settling", {});
  add_target(data, values_of(settling, {5.0, 3000.0}, data), 0.3, 7);
  const std::vector<NextTest> tests = next_tests(empty_model(), data, undecided(empty_model(), data, {settling}));
  ASSERT_FALSE(tests.empty());
  EXPECT_EQ(tests.front().name, "new set-up");
  EXPECT_NE(tests.front().text.find("It would show whether settling comes again with d = "), std::string::npos);
  EXPECT_GT(tests.front().separation, 20.0);
  EXPECT_NEAR(tests.front().separation_so_far, 0.0, 1e-6);
}

// The text with its numbers of d struck out.
std::string without_d(std::string text) {
  for (std::size_t at = text.find("d = "); at != std::string::npos; at = text.find("d = ", at + 4)) {
    std::size_t end = at + 4;
    while (end < text.size() && (std::isdigit(static_cast<unsigned char>(text[end])) || text[end] == '.')) ++end;
    if (text[end - 1] == '.') --end;
    text.replace(at + 4, end - at - 4, "#");
  }
  return text;
}

TEST(next_test, the_text_is_whole_sentences) {
  Series data = machine(4 * 60, start_and_stop, wandering_room);
  const Term room = term_of("lagged_expansion", {"T_room_degC"}), housing = term_of("expansion", {"T_housing_degC"});
  add_target(data, values_of(room, {3.0, 1800.0}, data), 1.0, 8);
  const Model model = empty_model();
  EXPECT_EQ(without_d(named(next_tests(model, data, undecided(model, data, {room, housing})), "stop and go").text),
            "Stop and go: 1 h at rest, 1 h at 5000 rpm, 1 h at rest, readings every 1 min as now. It would tell "
            "lagged_expansion(T_room_degC) from expansion(T_housing_degC) with d = # (named from 7.5); "
            "the data so far have d = #. Predicted as in the data: T_housing_degC (R2 = 1.00).");
  const std::vector<Term> three{room, term_of("expansion", {"T_room_degC"}), term_of("day_cycle", {})};
  EXPECT_EQ(without_d(next_tests(model, data, undecided(model, data, three)).front().text),
            "Room step at rest: 4 h at rest, after 1 h the room made 3 K warmer (door, air conditioning), readings "
            "every 1 min as now. Of 3 pairs of candidates it would settle 3 (d of 7.5 or more); the hardest is to show "
            "whether lagged_expansion(T_room_degC) is more than expansion(T_room_degC): d = # (named from 7.5); the "
            "data so far have d = #.");
}

// Two sensors side by side.
TEST(next_test, that_no_test_helps_is_said) {
  Series data = machine(4 * 60, start_and_stop, wandering_room);
  data.columns.push_back({"T_twin_degC", Role::housing, data.columns[2].values});
  const Term housing = term_of("expansion", {"T_housing_degC"});
  add_target(data, values_of(housing, {1.0}, data), 0.3, 15);
  const Model model = empty_model();
  const std::vector<NextTest> tests =
      next_tests(model, data, undecided(model, data, {housing, term_of("expansion", {"T_twin_degC"})}));
  ASSERT_GT(tests.size(), 1U);
  EXPECT_EQ(tests[0].text,
            fmt::format("None on the list would tell all of them apart: the best ({}) reaches d = 0.0, 5 is needed.",
                        tests[0].name))
      << tests[0].text;
  EXPECT_EQ(tests[1].text.find("No test"), std::string::npos);
}

TEST(next_test, a_squareness_is_told_from_an_oval_form_by_the_radius) {
  const Series trace = circles(false, 20.0, 17);
  const std::vector<Term> competitors{term_of("squareness", {"angle_rad", "radius_mm"}, Level::recording),
                                      term_of("oval", {"angle_rad"}, Level::recording)};
  const std::vector<NextTest> tests = next_tests(circle_model(), trace, undecided(circle_model(), trace, competitors));
  ASSERT_FALSE(tests.empty());
  EXPECT_EQ(tests.front().name, "another radius");
  EXPECT_NE(tests.front().text.find("with a bar of 50 mm"), std::string::npos) << tests.front().text;
  // (1, 1) against (1, 1 / 2): sine sqrt(1 / 10); of the shorter, sqrt(5 / 4) 44.7, is left 15.8.
  EXPECT_NEAR(tests.front().separation, 15.0, 3.0);
}

// Half of 150 mm is no bar.
TEST(next_test, another_radius_is_that_of_a_bar_there_is) {
  for (const auto& [bar_mm, other] : {std::pair{150.0, "100 mm"}, {300.0, "150 mm"}, {50.0, "100 mm"}}) {
    Series trace = circles(false, 20.0, 17);
    for (Column& column : trace.columns) {
      if (column.name == "radius_mm") std::fill(column.values.begin(), column.values.end(), bar_mm);
    }
    const std::vector<Term> competitors{term_of("squareness", {"angle_rad", "radius_mm"}, Level::recording),
                                        term_of("oval", {"angle_rad"}, Level::recording)};
    const std::vector<NextTest> tests =
        next_tests(circle_model(), trace, undecided(circle_model(), trace, competitors));
    EXPECT_NE(named(tests, "another radius").text.find(fmt::format("a bar of {}", other)), std::string::npos) << bar_mm;
  }
}

// A chiller that follows the load a little: the housing behind it or a drift.
TEST(next_test, a_coolant_step_where_there_is_a_coolant) {
  Series data = machine(4 * 60, start_once, wandering_room);
  Column coolant{"T_coolant_degC", Role::coolant, {}};
  for (const double warm : data.columns[2].values) coolant.values.push_back(20.0 + 0.1 * (warm - 20.0));
  data.columns.push_back(coolant);
  const Term lagged = term_of("lagged_expansion", {"T_coolant_degC"});
  add_target(data, values_of(lagged, {6.0, 1800.0}, data), 0.3, 18);
  const std::vector<Term> competitors{lagged, term_of("speed_heating", {"speed_rpm"})};
  const std::vector<NextTest> tests = next_tests(empty_model(), data, undecided(empty_model(), data, competitors));
  ASSERT_FALSE(tests.empty());
  EXPECT_EQ(tests.front().name, "coolant step");
  EXPECT_GT(tests.front().separation, 20.0);
}

// The load goes with the only speed: either may heat. Twice the load at the same speed tells them apart.
TEST(next_test, a_load_step_where_there_is_a_load) {
  Series data = machine(4 * 60, start_once, wandering_room);
  Column load{"load_W", Role::load, {}};
  for (const double rpm : find_column(data, "speed_rpm")->values) load.values.push_back(0.3 * rpm);
  data.columns.push_back(load);
  const Term heating = term_of("load_heating", {"load_W"});
  add_target(data, values_of(heating, {8.0, 1800.0}, data), 0.3, 19);
  const std::vector<Term> competitors{heating, term_of("speed_heating", {"speed_rpm"})};
  const std::vector<NextTest> tests = next_tests(empty_model(), data, undecided(empty_model(), data, competitors));
  ASSERT_FALSE(tests.empty());
  EXPECT_EQ(tests.front().name, "load step");
  EXPECT_GT(tests.front().separation, 10.0);
  EXPECT_LT(named(tests, "stop and go").separation, 0.2 * tests.front().separation);
}

// One effect of a room, weak in the data: a step of the room would show it again.
TEST(next_test, a_single_candidate_is_to_come_again) {
  Series data = machine(6 * 60, start_and_stop, wandering_room);
  const Term room = term_of("lagged_expansion", {"T_room_degC"});
  add_target(data, values_of(room, {1.0, 3600.0}, data), 0.5, 16);
  const std::vector<NextTest> tests = next_tests(empty_model(), data, undecided(empty_model(), data, {room}));
  ASSERT_FALSE(tests.empty());
  EXPECT_EQ(tests.front().name.substr(0, 9), "room step");
  EXPECT_NE(tests.front().text.find("show whether lagged_expansion(T_room_degC) comes again"), std::string::npos);
  EXPECT_NEAR(named(tests, "at rest").separation, 0.0, 1e-6);
}

TEST(next_test, nothing_open_nothing_proposed) {
  Series data = machine(120, start_and_stop, wandering_room);
  const Term settling = term_of("settling", {}), drift = term_of("linear_drift", {});
  add_target(data, values_of(settling, {5.0, 3000.0}, data), 0.3, 9);
  const Model model = empty_model();
  EXPECT_TRUE(next_tests(model, data, Diagnosis{}).empty());
  EXPECT_TRUE(next_tests(model, data, undecided(model, data, {})).empty());
  Diagnosis nothing = undecided(model, data, {settling, drift});
  EXPECT_FALSE(next_tests(model, data, nothing).empty());
  nothing.verdict = Verdict::nothing;
  EXPECT_TRUE(next_tests(model, data, nothing).empty());
}

TEST(next_test, a_diagnosis_of_other_data_is_refused) {
  Series data = machine(120, start_and_stop, wandering_room);
  const Term settling = term_of("settling", {}), drift = term_of("linear_drift", {});
  add_target(data, values_of(settling, {5.0, 3000.0}, data), 0.3, 10);
  const Diagnosis diagnosis = undecided(empty_model(), data, {settling, drift});
  Series shorter = data;
  shorter.time_s.resize(50);
  for (Column& column : shorter.columns) column.values.resize(50);
  EXPECT_TRUE(next_tests(empty_model(), shorter, diagnosis).empty());
  Model other = empty_model();
  other.terms.push_back(term_of("expansion", {"T_room_degC"}));
  EXPECT_TRUE(next_tests(other, data, diagnosis).empty());
  data.columns.pop_back();
  EXPECT_TRUE(next_tests(empty_model(), data, diagnosis).empty());
}

// Names of the tests, all numbers checked to be numbers.
std::vector<std::string> names_of(const Model& model, const Series& data, const std::vector<Term>& competitors) {
  std::vector<std::string> names;
  double last = std::numeric_limits<double>::infinity();
  for (const NextTest& test : next_tests(model, data, undecided(model, data, competitors))) {
    EXPECT_TRUE(std::isfinite(test.separation) && std::isfinite(test.separation_so_far)) << test.name;
    EXPECT_GE(test.separation, test.separation_so_far * 0.999) << test.name;
    EXPECT_LE(test.separation, last);
    EXPECT_GT(test.duration_s, 0.0);
    EXPECT_FALSE(test.text.empty());
    last = test.separation;
    names.push_back(test.name);
  }
  std::sort(names.begin(), names.end());
  return names;
}

TEST(next_test, odd_data) {
  const Term settling = term_of("settling", {}), drift = term_of("linear_drift", {});
  Series data = machine(4 * 60, start_and_stop, wandering_room);
  add_target(data, values_of(settling, {5.0, 3000.0}, data), 0.3, 11);
  const std::vector<std::string> rest{"at rest", "new set-up", "room step at rest", "the same again"};
  const std::vector<std::string> no_room{"at rest", "new set-up", "the same again"};

  Series without_speed = data;
  without_speed.columns.erase(without_speed.columns.begin());
  EXPECT_EQ(names_of(empty_model(), without_speed, {settling, drift}), rest);
  Series only_target = data;
  only_target.columns.erase(only_target.columns.begin(), only_target.columns.begin() + 3);
  EXPECT_EQ(names_of(empty_model(), only_target, {settling, drift}), no_room);

  // Gaps: in the room, in a column that nobody reads, in the speed.
  Series gaps = data;
  const double kGap = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = 0; i < gaps.time_s.size(); ++i) {
    if (i % 3 == 0) gaps.columns[0].values[i] = kGap;
    if (i < 20) gaps.columns[1].values[i] = kGap;
    gaps.columns[2].values[i] = kGap;
  }
  EXPECT_EQ(names_of(empty_model(), gaps, {settling, drift}).size(), 10U);
  for (double& value : gaps.columns[1].values) value = kGap;
  EXPECT_EQ(names_of(empty_model(), gaps, {settling, drift}).size(), 8U);
}

// 17 readings, 20 min apart, of 5 h of signals every 4 s; the model is there already.
TEST(next_test, few_readings_among_many_signals) {
  Series signals = machine(5 * 60, start_and_stop, wandering_room), data;
  for (std::size_t i = 0; i < 5 * 900; ++i) data.time_s.push_back(4.0 * static_cast<double>(i));
  for (const Column& column : signals.columns) {
    data.columns.push_back({column.name, column.role, {}});
    for (std::size_t i = 0; i < data.time_s.size(); ++i) data.columns.back().values.push_back(column.values[i / 15]);
  }
  std::vector<double> target(data.time_s.size(), std::numeric_limits<double>::quiet_NaN());
  const Term lagged = term_of("lagged_expansion", {"T_housing_degC"});
  const std::vector<double> truth = values_of(lagged, {2.0, 1800.0}, data);
  std::mt19937_64 random(12);
  for (std::size_t i = 0; i < 17 * 250; i += 250) target[i] = truth[i] + std::normal_distribution(0.0, 0.2)(random);
  data.columns.push_back({"z_um", Role::measured, target});
  Model model = empty_model();
  model.terms = {term_of("expansion", {"T_room_degC"})};
  EXPECT_EQ(names_of(model, data, {lagged, term_of("speed_heating", {"speed_rpm"}), term_of("settling", {})}).size(),
            10U);
}

// A temperature that wanders by itself: what it would do in a test is not known, but for the same again.
TEST(next_test, nothing_is_promised_for_a_column_that_follows_nothing) {
  Series data = machine(6 * 60, start_and_stop, wandering_room);
  Column own{"T_own_degC", Role::structure, {}};
  std::mt19937_64 random(13);
  double value = 20.0;
  for (std::size_t i = 0; i < data.time_s.size(); ++i) {
    own.values.push_back(value + std::sin(static_cast<double>(i) / 9.0));
  }
  data.columns.push_back(own);
  const Term expansion = term_of("expansion", {"T_own_degC"});
  add_target(data, values_of(expansion, {2.0}, data), 0.3, 14);
  const std::vector<Term> competitors{expansion, term_of("lagged_expansion", {"T_own_degC"})};
  for (const NextTest& test : next_tests(empty_model(), data, undecided(empty_model(), data, competitors))) {
    if (test.name == "the same again" || test.name == "new set-up") continue;
    EXPECT_EQ(test.separation, test.separation_so_far);
    EXPECT_NE(test.text.find("What T_own_degC would do in it is not known"), std::string::npos) << test.text;
  }
}

}  // namespace
}  // namespace ballbar
