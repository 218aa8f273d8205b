// Effects hidden in made data: what the verdict must be where there is no doubt.
#include "ballbar/diagnosis/verdict/diagnosis.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <regex>
#include <set>
#include <string>

#include "ballbar/circle/trace.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kRows = 400;

// First-order lag over one row of 100 s, its input a straight line: what the speed does between two rows is not known.
double lagged(double value, double from, double to, double tau_s) {
  constexpr int kSteps = 200;
  for (int k = 0; k < kSteps; ++k) {
    const double input = from + (to - from) * (k + 0.5) / kSteps;
    value += (input - value) * (1.0 - std::exp(-100.0 / kSteps / tau_s));
  }
  return value;
}

// Speeds of 1.5 h, a room that swings and steps, a bearing that warms with the speed; noise AR(1) 0.8 of 0.3 um.
Series made(double room_um_per_K, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  Series data;
  Column speed{"speed_rpm", Role::speed, {}}, room{"T_room_degC", Role::ambient, {}},
      bearing{"T_bearing_degC", Role::bearing, {}}, target{"z_um", Role::measured, {}};
  const double speeds[] = {0, 4000, 8000, 0, 6000, 2000, 8000, 0};
  double heat = 0.0, warm = 0.0, slow = 0.0, noise = 0.0, n_before = 0.0, room_before = 0.0;
  for (std::size_t i = 0; i < kRows; ++i) {
    const double t = static_cast<double>(i) * 100.0;
    const double n = speeds[static_cast<std::size_t>(t / 5400.0) % 8];
    const double room_now =
        22.0 + 0.8 * std::sin(t / 3100.0) + 0.5 * std::sin(t / 1300.0 + 1.0) + (t > 21000.0 ? 1.5 : 0.0);
    if (i == 0) slow = room_before = room_now;
    heat = lagged(heat, std::pow(n_before / 1000.0, 5.0 / 3.0), std::pow(n / 1000.0, 5.0 / 3.0), 2300.0);
    warm = lagged(warm, n_before / 1000.0, n / 1000.0, 900.0);
    slow = lagged(slow, room_before, room_now, 1500.0);
    n_before = n;
    room_before = room_now;
    noise = 0.8 * noise + 0.6 * 0.3 * normal(random);
    data.time_s.push_back(t);
    speed.values.push_back(n);
    room.values.push_back(room_now + 0.02 * normal(random));
    bearing.values.push_back(23.0 + 1.4 * warm + 0.02 * normal(random));
    target.values.push_back(0.4 * heat + room_um_per_K * (slow - 22.0) + noise);
  }
  data.columns = {speed, room, bearing, target};
  return data;
}

Model by_speed() {
  Model model;
  model.targets = {"z_um"};
  model.terms = {term_of("speed_heating", {"speed_rpm"})};
  return model;
}

TEST(Diagnosis, names_the_room_and_its_gain) {
  const Diagnosis found = diagnose(by_speed(), made(3.0, 1));
  EXPECT_EQ(found.verdict, Verdict::named);
  ASSERT_EQ(found.named.size(), 1U);
  EXPECT_EQ(label_of(found.named.front()), "lagged_expansion(T_room_degC)");
  ASSERT_FALSE(found.candidates.empty());
  const Candidate& best = found.candidates.front();
  EXPECT_TRUE(best.in_best_set);
  EXPECT_EQ(best.beats_surrogates, true);
  EXPECT_GT(best.likelihood_ratio, best.threshold);
  EXPECT_NEAR(best.parameters[0].value, 3.0, 4.0 * best.parameters[0].sigma);
  EXPECT_LT(best.held_out_after_um, 0.5 * best.held_out_before_um);
  EXPECT_LT(found.rmse_after_um, 0.5 * found.base.rmse_um);
}

// 20 um/K at once, less 20 um/K with a lag: 3 um are left of two curves of 40 um.
TEST(Diagnosis, names_nothing_whose_curves_nearly_cancel) {
  Series data = made(-20.0, 1);
  const std::vector<double>& room = find_column(data, "T_room_degC")->values;
  for (std::size_t i = 0; i < kRows; ++i) data.columns.back().values[i] += 20.0 * (room[i] - 22.0);
  DiagnosisOptions options;
  options.search.draws = 500;
  options.surrogates = 20;
  const Diagnosis found = diagnose(by_speed(), data, 0, options);
  EXPECT_TRUE(found.named.empty());
  EXPECT_TRUE(std::any_of(found.reasons.begin(), found.reasons.end(),
                          [](const std::string& why) { return why.starts_with("The best effects nearly cancel"); }));
}

TEST(Diagnosis, nothing_hidden_is_nothing) {
  int called = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    DiagnosisOptions options;
    options.search.seed = seed;
    options.search.draws = 500;
    options.surrogates = 20;
    const Diagnosis found = diagnose(by_speed(), made(0.0, seed), 0, options);
    called += found.verdict == Verdict::nothing ? 0 : 1;
    EXPECT_TRUE(found.named.empty()) << seed;
    EXPECT_GT(found.smallest_um, 0.0);
  }
  EXPECT_LE(called, 1);  // a false call in 2 % of data sets: two of eight in 1 %
}

TEST(Diagnosis, says_nothing_of_an_effect_that_is_not_searched) {
  DiagnosisOptions options;
  options.search.draws = 500;
  options.surrogates = 20;
  options.search.without = {"lagged_expansion"};
  const Diagnosis found = diagnose(by_speed(), made(3.0, 1), 0, options);
  const auto is_it = [](const auto& one) { return one.effect->name == "lagged_expansion"; };
  EXPECT_TRUE(std::none_of(found.named.begin(), found.named.end(), is_it));
  EXPECT_TRUE(std::none_of(found.detectability.begin(), found.detectability.end(), is_it));
  EXPECT_FALSE(found.candidates.empty());
  for (const Candidate& candidate : found.candidates) EXPECT_FALSE(is_it(candidate.bound));
}

TEST(Diagnosis, tells_what_it_does) {
  std::vector<std::string> steps;
  DiagnosisOptions options;
  options.search.draws = 500;
  options.surrogates = 20;
  options.search.progress = [&](std::string_view step) { steps.emplace_back(step); };
  const Diagnosis found = diagnose(by_speed(), made(3.0, 1), 0, options);
  ASSERT_GE(steps.size(), 5U);
  EXPECT_TRUE(std::regex_match(steps[0], std::regex("searching [0-9]+ shapes of [0-9]+ effects"))) << steps[0];
  EXPECT_EQ(steps[1], "searching 500 data sets without any effect");
  EXPECT_TRUE(std::regex_match(steps[2], std::regex("fitting [0-9]+ sets of effects"))) << steps[2];
  EXPECT_EQ(steps.back(), "testing 20 surrogates of " + label_of(found.candidates.front().bound));
  // Telling changes nothing.
  options.search.progress = {};
  EXPECT_EQ(diagnose(by_speed(), made(3.0, 1), 0, options).p_anything, found.p_anything);
}

// The same column twice under two names: no data tell them apart.
TEST(Diagnosis, a_duplicate_is_never_named) {
  Series data = made(3.0, 2);
  Column twin = data.columns[1];
  twin.name = "T_twin_degC";
  data.columns.insert(data.columns.begin(), twin);
  const Diagnosis found = diagnose(by_speed(), data);
  EXPECT_EQ(found.verdict, Verdict::equivalent);
  EXPECT_TRUE(found.named.empty());
  ASSERT_EQ(found.equivalent.size(), 1U);
  std::vector<std::string> labels;
  for (const BoundEffect& bound : found.equivalent.front()) labels.push_back(label_of(bound));
  EXPECT_NE(std::find(labels.begin(), labels.end(), "lagged_expansion(T_room_degC)"), labels.end());
  EXPECT_NE(std::find(labels.begin(), labels.end(), "lagged_expansion(T_twin_degC)"), labels.end());
}

// A lag of no time and play that never gives way are expansion too: the one with fewer shapes is named.
// A bearing that grows, or the difference between it and a room that stands still: no one can tell.
TEST(Diagnosis, a_temperature_that_stands_still_may_be_half_of_a_difference) {
  Series data = made(0.0, 3);
  Column& room = data.columns[1];
  std::fill(room.values.begin(), room.values.end(), 22.0);
  for (std::size_t i = 0; i < kRows; ++i) data.columns[3].values[i] += 2.0 * (data.columns[2].values[i] - 23.0);
  const Diagnosis found = diagnose(by_speed(), data);
  EXPECT_EQ(found.verdict, Verdict::equivalent);
  EXPECT_TRUE(found.named.empty());
  bool bends = false;
  for (const std::vector<BoundEffect>& group : found.equivalent) {
    for (const BoundEffect& one : group)
      bends = bends || label_of(one) == "gradient_bending(T_bearing_degC, T_room_degC)";
  }
  EXPECT_TRUE(bends);
}

TEST(Diagnosis, what_becomes_the_same_curve_is_no_competitor) {
  std::set<std::string> also;
  int named = 0;
  for (std::uint64_t seed = 4; seed <= 9; ++seed) {
    Series data = made(0.0, seed);
    for (std::size_t i = 0; i < kRows; ++i) data.columns[3].values[i] += 0.6 * (data.columns[1].values[i] - 22.0);
    const Diagnosis found = diagnose(by_speed(), data);
    if (found.verdict != Verdict::named) continue;
    ++named;
    EXPECT_EQ(label_of(found.named.front()), "expansion(T_room_degC)") << seed;
    const std::vector<std::string>& same = found.candidates.front().also_drawn_by;
    also.insert(same.begin(), same.end());
  }
  for (const std::string& label : also) {
    EXPECT_TRUE(label == "lagged_expansion(T_room_degC)" || label == "play_hysteresis(T_room_degC)") << label;
  }
  EXPECT_FALSE(also.empty());
  EXPECT_GE(named, 4);
}

// A law that no effect of the catalogue has: unexplained, and what it goes with is told.
TEST(Diagnosis, what_is_outside_the_catalogue_goes_with_its_input) {
  Series data = made(0.0, 5);
  for (std::size_t i = 0; i < kRows; ++i) {
    const double room = data.columns[1].values[i] - 22.0;
    data.columns[3].values[i] += 9.0 * room + 4.0 * std::sin(4.0 * room);
  }
  const Diagnosis found = diagnose(by_speed(), data);
  EXPECT_EQ(found.verdict, Verdict::unexplained);
  EXPECT_TRUE(found.named.empty());
  ASSERT_FALSE(found.associations.empty());
  for (const Candidate& candidate : found.associations) {
    EXPECT_NE(label_of(candidate.bound).find("T_room_degC"), std::string::npos) << label_of(candidate.bound);
    EXPECT_LT(candidate.held_out_after_um, 0.7 * candidate.held_out_before_um);
  }
}

// Nothing moves, so there is nothing to explain: it once had no set of effects to begin with, and crashed.
TEST(Diagnosis, a_constant_target) {
  Series data = made(0.0, 6);
  std::fill(data.columns[3].values.begin(), data.columns[3].values.end(), 5.0);
  const Diagnosis found = diagnose(by_speed(), data);
  EXPECT_TRUE(found.named.empty());
  EXPECT_TRUE(found.equivalent.empty());
}

// The room moves once: what it does then is predicted by no other time.
TEST(Diagnosis, an_input_that_moves_once_is_not_named) {
  Series data = made(0.0, 7);
  for (std::size_t i = 0; i < kRows; ++i) {
    const double into_s = data.time_s[i] - 22000.0;
    data.columns[1].values[i] = into_s > 0.0 && into_s < 4000.0 ? 22.0 + 2.0 * (1.0 - std::exp(-into_s / 900.0)) : 22.0;
    if (into_s > 0.0 && into_s < 4000.0) data.columns[3].values[i] += 5.0 * (1.0 - std::exp(-into_s / 700.0));
  }
  EXPECT_TRUE(diagnose(by_speed(), data).named.empty());
}

TEST(Diagnosis, is_the_same_every_time) {
  const Series data = made(2.0, 3);
  const Diagnosis once = diagnose(by_speed(), data), again = diagnose(by_speed(), data);
  EXPECT_EQ(once.verdict, again.verdict);
  ASSERT_EQ(once.candidates.size(), again.candidates.size());
  for (std::size_t i = 0; i < once.candidates.size(); ++i) {
    EXPECT_EQ(once.candidates[i].likelihood_ratio, again.candidates[i].likelihood_ratio);
    EXPECT_EQ(once.candidates[i].p_search, again.candidates[i].p_search);
  }
}

TEST(Diagnosis, too_few_values_are_untestable) {
  Series data = made(3.0, 4);
  for (std::size_t i = 0; i < kRows; ++i) {
    if (i % 80 != 0) data.columns.back().values[i] = std::nan("");
  }
  const Diagnosis found = diagnose(by_speed(), data);
  EXPECT_EQ(found.verdict, Verdict::untestable);
  EXPECT_FALSE(found.reasons.empty());
}

// A model without any live column: its input never changes and its constant is held.
TEST(Diagnosis, a_model_that_makes_nothing) {
  Series data = made(3.0, 6);
  data.columns.push_back({"T_still_degC", Role::structure, std::vector<double>(kRows, 20.0)});
  Model model;
  model.targets = {"z_um"};
  model.terms = {term_of("expansion", {"T_still_degC"})};
  model.constant_um = 0.0;
  EXPECT_NE(diagnose(model, data).verdict, Verdict::nothing);
}

// 18 tests, 20 min apart, sigma stated; signals every 100 s.
TEST(Diagnosis, a_session_of_few_tests) {
  Series data = made(6.0, 5);
  Column sigma{"z_sigma_um", Role::measured, std::vector<double>(kRows, std::nan(""))};
  for (std::size_t i = 0; i < kRows; ++i) {
    if (i % 22 == 0) {
      sigma.values[i] = 0.3;
    } else {
      data.columns.back().values[i] = std::nan("");
    }
  }
  data.columns.push_back(sigma);
  const Diagnosis found = diagnose(by_speed(), data);
  EXPECT_TRUE(found.verdict == Verdict::named || found.verdict == Verdict::equivalent);
  const auto is_room = [](const BoundEffect& bound) {
    return bound.columns == std::vector<std::string>{"T_room_degC"};
  };
  const bool in_set = std::any_of(found.named.begin(), found.named.end(), is_room) ||
                      std::any_of(found.equivalent.begin(), found.equivalent.end(),
                                  [&](const auto& group) { return std::any_of(group.begin(), group.end(), is_room); });
  EXPECT_TRUE(in_set);
}

}  // namespace
}  // namespace ballbar
