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
#include "diagnosis/next_test/discrimination_matrix.hpp"
#include "diagnosis/next_test/planned_test.hpp"
#include "diagnosis/next_test/thermal_forecast.hpp"
#include "effects/low_pass.hpp"
#include "noise/whitening.hpp"

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
double rising_room(double hours) { return 20.0 + 0.2 * hours; }
double wandering_room(double hours) { return 20.0 + std::sin(hours / 0.9); }

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

// Data and test are simulated from the truth, with the housing that the machine would really have; the competitors are
// fitted to both by an exhaustive search. d scatters by 1.

// Two sensors side by side.

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

// The load goes with the only speed: either may heat. Twice the load at the same speed tells them apart.

// One effect of a room, weak in the data: a step of the room would show it again.

// 17 readings, 20 min apart, of 5 h of signals every 4 s; the model is there already.

// A temperature that wanders by itself: what it would do in a test is not known, but for the same again.

}  // namespace
}  // namespace ballbar
