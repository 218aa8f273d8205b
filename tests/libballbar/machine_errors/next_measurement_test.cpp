// Which measurement separates errors that the recordings do not tell apart.
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "ballbar/circle/recording.hpp"
#include "ballbar/machine_errors/machine_errors.hpp"
#include "made_errors.hpp"

namespace ballbar {
namespace {

std::vector<Recording> one_run(const made::ErrorTest& test) { return {made::both_runs(test).front()}; }

TEST(NextMeasurement, OneDirectionAsksForTheOther) {
  const MachineErrors found = machine_errors(one_run(made::noisy(made::full_turn())));
  ASSERT_TRUE(found.next);
  EXPECT_EQ(found.next->measurement, Measurement::other_direction);
  EXPECT_EQ((std::set{found.next->error, found.next->other}), (std::set<std::string>{"servo_mismatch", "squareness"}));
}

TEST(NextMeasurement, AnArcInBothDirectionsAsksForAFullCircle) {
  for (const double arc_deg : {90.0, 180.0, 220.0}) {
    made::ErrorTest test = made::noisy(made::arc_220());
    test.arc_deg = arc_deg;
    const MachineErrors found = machine_errors(made::both_runs(test));
    ASSERT_TRUE(found.next) << arc_deg;
    EXPECT_EQ(found.next->measurement, Measurement::full_circle) << arc_deg;
    EXPECT_NE(found.next->error, found.next->other);
  }
}

// Radius change and both lateral plays are alike there, and stay so whatever is measured in addition.
TEST(NextMeasurement, FullCirclesInBothDirectionsAskForNothing) {
  for (const double feed_mm_per_min : {500.0, 1000.0, 3000.0}) {
    made::ErrorTest test = made::noisy(made::full_turn());
    test.feed_mm_per_min = feed_mm_per_min;
    const MachineErrors found = machine_errors(made::both_runs(test));
    EXPECT_FALSE(found.undetermined.empty());
    EXPECT_FALSE(found.next) << found.next->error << " and " << found.next->other;
  }
}

TEST(NextMeasurement, IsNotComputedWithoutDetails) {
  EXPECT_FALSE(machine_errors(one_run(made::noisy(made::full_turn())), {.details = false}).next);
}

// Five waves a turn in both directions: of the angle, or of the time, 5 times the frequency of the turns.
TEST(NextMeasurement, LobesAreToldFromAVibrationByTheFeed) {
  const made::ErrorTest test = made::full_turn();
  const double turns_Hz = test.feed_mm_per_min / 60.0 / (2.0 * std::numbers::pi * test.radius_mm);
  const std::vector<ShapedEffect> effects{{find_effect("lobing", Level::recording), 5.0},
                                          {find_effect("vibration", Level::recording), 5.0 * turns_Hz}};
  const std::vector<Recording> runs = made::both_runs(test);
  const std::optional<NextMeasurement> next = next_measurement(trace_of(runs), effects);
  ASSERT_TRUE(next);
  EXPECT_EQ(next->measurement, Measurement::another_feed);
  EXPECT_EQ((std::set{next->error, next->other}), (std::set<std::string>{"lobing", "vibration"}));

  std::vector<Recording> two_feeds = runs;
  made::ErrorTest faster = test;
  faster.feed_mm_per_min *= 2.0;
  for (const Recording& run : made::both_runs(faster)) two_feeds.push_back(run);
  EXPECT_FALSE(next_measurement(trace_of(two_feeds), effects));
}

// The same effect under two names: no measurement tells.
TEST(NextMeasurement, OfEqualEffectsThereIsNone) {
  const Effect* lobing = find_effect("lobing", Level::recording);
  Effect same = *lobing;
  same.name = "same";
  const std::vector<ShapedEffect> effects{{lobing, 3.0}, {&same, 3.0}};
  EXPECT_FALSE(next_measurement(trace_of(one_run(made::full_turn())), effects));
}

}  // namespace
}  // namespace ballbar
