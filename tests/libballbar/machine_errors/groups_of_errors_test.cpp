// Errors that one direction cannot separate, and steps of play that take an angle.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "ballbar/machine_errors/machine_errors.hpp"
#include "made_errors.hpp"

namespace ballbar {
namespace {

std::vector<std::string> names_of(const ErrorGroup& group) {
  std::vector<std::string> names;
  for (const Effect* effect : group.effects) names.push_back(effect->name);
  std::sort(names.begin(), names.end());
  return names;
}

const MachineError& row_of(const MachineErrors& found, const std::string& name) {
  return *std::find_if(found.errors.begin(), found.errors.end(),
                       [&](const MachineError& one) { return one.name == name; });
}

const RankedError* ranked_of(const MachineErrors& found, const std::string& name) {
  const auto at = std::find_if(found.ranked.begin(), found.ranked.end(),
                               [&](const RankedError& one) { return one.effect->name == name; });
  return at == found.ranked.end() ? nullptr : &*at;
}

made::ErrorTest with(std::map<std::string, double> errors) {
  made::ErrorTest test = made::noisy(made::full_turn());
  test.errors = std::move(errors);
  return test;
}

// 40 um/m of squareness over 0.15 m are 6 um.
TEST(GroupsOfErrors, one_direction_says_squareness_or_servo_mismatch) {
  for (const bool has_feed : {true, false}) {
    for (Recording run : made::both_runs(with({{"squareness", 40.0}}))) {
      const double sign = run.direction == Direction::CCW ? -1.0 : 1.0;
      if (!has_feed) run.feed_mm_per_min.reset();
      const MachineErrors found = machine_errors(std::vector{run});
      ASSERT_EQ(found.groups.size(), 1U);
      const ErrorGroup& group = found.groups.front();
      EXPECT_EQ(names_of(group), (std::vector<std::string>{"servo_mismatch", "squareness"}));
      EXPECT_EQ(group.rank, 1U);
      EXPECT_NEAR(group.individual_circularity_um, 6.0, 4.0 * group.sigma_um);
      EXPECT_LT(group.sigma_um, 0.6);
      ASSERT_EQ(group.alone.size(), 2U);
      for (const MachineError& alone : group.alone) {
        const double truth = alone.name == "squareness" ? 40.0 : sign * 6.0 / (has_feed ? 1000.0 / 60.0 : 1.0);
        EXPECT_NEAR(alone.value, truth, 4.0 * alone.sigma) << alone.name;
        EXPECT_LT(alone.sigma, 0.1 * std::abs(truth)) << alone.name;
        EXPECT_EQ(alone.unit, alone.name == "squareness" ? "um/m" : has_feed ? "ms" : "um");
      }
      for (const RankedError& one : found.ranked) EXPECT_FALSE(one.significant) << one.effect->name;
      ASSERT_EQ(found.one_by_one.size(), 1U);
      EXPECT_EQ(found.one_by_one.front().group, 0U);
      ASSERT_TRUE(found.next);
      EXPECT_EQ(found.next->measurement, Measurement::other_direction);
    }
  }
}

TEST(GroupsOfErrors, both_directions_have_none) {
  const MachineErrors found = machine_errors(made::both_runs(with({{"squareness", 40.0}})));
  EXPECT_TRUE(found.groups.empty());
  EXPECT_TRUE(ranked_of(found, "squareness")->significant);
  EXPECT_FALSE(ranked_of(found, "servo_mismatch")->significant);
}

TEST(GroupsOfErrors, without_a_feed_the_servo_mismatch_of_both_directions_is_in_um) {
  std::vector<Recording> runs = made::both_runs(with({{"servo_mismatch", 0.3}}));
  for (Recording& run : runs) run.feed_mm_per_min.reset();
  const MachineErrors found = machine_errors(runs);
  const MachineError& row = row_of(found, "servo_mismatch");
  EXPECT_EQ(row.unit, "um");
  EXPECT_NEAR(row.value, 0.3 * 1000.0 / 60.0, 4.0 * row.sigma);
  EXPECT_TRUE(ranked_of(found, "servo_mismatch")->significant);
}

TEST(GroupsOfErrors, nothing_is_no_group) {
  for (const Recording& run : made::both_runs(with({}))) EXPECT_TRUE(machine_errors(std::vector{run}).groups.empty());
}

TEST(StepsOfPlay, have_a_width_and_no_spike) {
  for (const double width_deg : {0.0, 0.3, 0.7, 1.5}) {
    made::ErrorTest test = with({{"backlash_a_pos", 4.0}, {"backlash_a_neg", 4.0}});
    test.step_width_deg = width_deg;
    const MachineErrors found = machine_errors(made::both_runs(test));
    const RankedError* play = ranked_of(found, "backlash_a");
    ASSERT_NE(play, nullptr);
    EXPECT_TRUE(play->significant);
    EXPECT_NEAR(play->shape.value_or(0.0), width_deg, 0.3);
    EXPECT_NEAR(row_of(found, "backlash_a_pos").value, 4.0, 4.0 * row_of(found, "backlash_a_pos").sigma);
    for (const char* spike : {"reversal_spike_a", "reversal_spike_b"}) {
      if (ranked_of(found, spike) == nullptr) continue;
      EXPECT_FALSE(ranked_of(found, spike)->significant) << spike << ", a step over " << width_deg << " deg";
    }
    EXPECT_LT(found.circularity_without_all_um, found.circularity_um - 1.5);
  }
}

// A step of 4 um that settles as 1 - exp(-d / w).
TEST(StepsOfPlay, that_settle_exponentially_have_no_spike) {
  for (const double settling_deg : {0.3, 0.7}) {
    made::ErrorTest test = with({{"backlash_a_pos", 4.0},
                                 {"backlash_a_neg", 4.0},
                                 {"reversal_spike_a_pos", -4.0},
                                 {"reversal_spike_a_neg", -4.0}});
    test.spike_width_deg = settling_deg;
    const MachineErrors found = machine_errors(made::both_runs(test));
    EXPECT_TRUE(ranked_of(found, "backlash_a")->significant);
    EXPECT_FALSE(ranked_of(found, "reversal_spike_a")->significant) << settling_deg;
  }
}

TEST(StepsOfPlay, with_a_spike_beside_them) {
  made::ErrorTest test = with(
      {{"backlash_a_pos", 2.0}, {"backlash_a_neg", 2.0}, {"reversal_spike_a_pos", 2.0}, {"reversal_spike_a_neg", 2.0}});
  const MachineErrors found = machine_errors(made::both_runs(test));
  EXPECT_TRUE(ranked_of(found, "backlash_a")->significant);
  EXPECT_TRUE(ranked_of(found, "reversal_spike_a")->significant);
}

}  // namespace
}  // namespace ballbar
