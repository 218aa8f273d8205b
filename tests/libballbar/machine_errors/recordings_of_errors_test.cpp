// What recordings there are: one direction, feeds, several tests, arcs, times; and what is refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "ballbar/error.hpp"
#include "ballbar/machine_errors/machine_errors.hpp"
#include "made_errors.hpp"

namespace ballbar {
namespace {

const MachineError* row_of(const MachineErrors& found, const std::string& name) {
  for (const MachineError& row : found.errors) {
    if (row.name == name) return &row;
  }
  return nullptr;
}

double value_of(const MachineErrors& found, const std::string& name) {
  const MachineError* row = row_of(found, name);
  return row == nullptr ? NAN : row->value;
}

double sigma_of(const MachineErrors& found, const std::string& name) {
  const MachineError* row = row_of(found, name);
  return row == nullptr ? NAN : row->sigma;
}

bool says(const std::vector<std::string>& phrases, const std::string& one, const std::string& other) {
  return std::any_of(phrases.begin(), phrases.end(), [&](const std::string& phrase) {
    return phrase.find(one) != std::string::npos && phrase.find(other) != std::string::npos;
  });
}

made::ErrorTest some_errors(made::ErrorTest test) {
  test.errors = {{"scale_mismatch", 8.0}, {"straightness_a", 3.0}, {"backlash_a_pos", 2.0}, {"backlash_b_neg", -1.5}};
  return test;
}

TEST(MachineErrorsOfOneDirection, HaveNoShiftsAndPredictNothing) {
  std::mt19937_64 random(1);
  const std::vector<Recording> ccw{made::run_of(made::noisy(some_errors(made::full_turn())), Direction::CCW, random)};
  const MachineErrors found = machine_errors(ccw);
  for (const char* name : {"radius_change", "offset_a_shift", "offset_b_shift"}) {
    EXPECT_EQ(row_of(found, name), nullptr) << name;
  }
  for (const RankedError& one : found.ranked) EXPECT_EQ(one.predicts_other_run, std::nullopt) << one.effect->name;
  EXPECT_TRUE(std::isnan(found.repeatability_um));
  EXPECT_NEAR(value_of(found, "straightness_a"), 3.0, 4.0 * sigma_of(found, "straightness_a"));
  EXPECT_NEAR(value_of(found, "backlash_a_pos"), 2.0, 4.0 * sigma_of(found, "backlash_a_pos"));
}

TEST(MachineErrorsOfOneDirection, SquarenessAndServoMismatchAreNotToldApart) {
  std::mt19937_64 random(1);
  const std::vector<Recording> cw{made::run_of(made::noisy(some_errors(made::full_turn())), Direction::CW, random)};
  EXPECT_TRUE(says(machine_errors(cw).undetermined, "squareness", "servo_mismatch"));
  const MachineErrors both = machine_errors(made::both_runs(made::noisy(some_errors(made::full_turn()))));
  EXPECT_FALSE(says(both.undetermined, "squareness", "servo_mismatch"));
}

// A delay of 0.25 ms is 2.1 um at 1000 mm/min and 6.3 um at 3000: one value for both.
TEST(MachineErrorsOfSeveralFeeds, ServoMismatchIsOneDelay) {
  std::vector<Recording> recordings;
  std::mt19937_64 random(1);
  for (const double feed : {1000.0, 3000.0}) {
    made::ErrorTest test = made::noisy(some_errors(made::full_turn()));
    test.errors["servo_mismatch"] = 0.25;
    test.errors["global_scale"] = feed / 1000.0;
    test.errors["centre_a"] = -feed / 500.0;
    test.feed_mm_per_min = feed;
    for (Recording& run : made::both_runs(test, random)) recordings.push_back(std::move(run));
  }
  const MachineErrors found = machine_errors(recordings);
  EXPECT_NEAR(value_of(found, "servo_mismatch"), 0.25, 4.0 * sigma_of(found, "servo_mismatch"));
  EXPECT_LT(sigma_of(found, "servo_mismatch"), 0.01);
  // The circle of the first test is that of the table; those of the others stand beside it.
  EXPECT_NEAR(value_of(found, "global_scale"), 1.0, 0.2);
  EXPECT_NEAR(value_of(found, "centre_a"), -2.0, 0.2);
  EXPECT_EQ(row_of(found, "global_scale_of_recording_3"), nullptr);
  double further_um = NAN;
  for (const FittedGain& gain : found.gains) {
    if (gain.name == "centre_a_of_recording_3") further_um = gain.value;
  }
  EXPECT_NEAR(further_um, -4.0, 0.3);
}

// Four tests tell twice as closely as one.
TEST(MachineErrorsOfSeveralTests, SigmaFallsWithTheirNumber) {
  std::vector<Recording> recordings;
  std::mt19937_64 random(7);
  for (int k = 0; k < 4; ++k) {
    made::ErrorTest test = made::noisy(some_errors(made::full_turn()));
    test.errors["centre_b"] = 10.0 * k;
    for (Recording& run : made::both_runs(test, random)) recordings.push_back(std::move(run));
  }
  const MachineErrors four = machine_errors(recordings);
  const MachineErrors one = machine_errors(std::span(recordings).first(2));
  for (const char* name : {"scale_mismatch", "squareness", "straightness_a"}) {
    EXPECT_NEAR(sigma_of(four, name) / sigma_of(one, name), 0.5, 0.15) << name;
  }
  EXPECT_NEAR(value_of(four, "scale_mismatch"), 8.0, 4.0 * sigma_of(four, "scale_mismatch"));
  EXPECT_NEAR(value_of(four, "centre_b"), 0.0, 0.3);
}

TEST(MachineErrorsOfAnArc, ReadingsAloneGiveBackWhatTheyTell) {
  made::ErrorTest test = some_errors(made::arc_220());
  MachineErrorOptions without;
  without.prior = false;
  const MachineErrors found = machine_errors(made::both_runs(test), without);
  for (const MachineError& row : found.errors) EXPECT_NEAR(row.value, test.of(row.name), 0.1) << row.name;
  EXPECT_TRUE(says(found.undetermined, "centre_a", "scale_mismatch"));
  EXPECT_TRUE(says(found.undetermined, "cubic_error", "for which a full turn is needed"));
  EXPECT_EQ(row_of(found, "cubic_error_along"), nullptr);
}

// An arc has no prior: ours says what the readings say, the instrument's column what it damps.
TEST(MachineErrorsOfAnArc, InstrumentDampsWhatTheReadingsDoNotTell) {
  made::ErrorTest test = made::noisy(made::arc_220());
  test.errors = {{"squareness", 30.0}};
  double ours = 0.0, damped = 0.0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const MachineErrors found = machine_errors(made::both_runs(test, seed));
    for (const char* name : {"straightness_b", "offset_a_shift"}) {
      const MachineError* const row = row_of(found, name);
      ours += row->value * row->value;
      damped += *row->as_instrument * *row->as_instrument;
    }
    EXPECT_NEAR(*row_of(found, "squareness")->as_instrument, 30.0, 15.0);
    for (const RankedError& one : found.ranked) {
      const bool of_full_turns = one.effect->rules.ranked_by_instrument != RankedByInstrument::always;
      EXPECT_EQ(one.as_instrument.has_value(), !of_full_turns) << one.effect->name;
    }
  }
  EXPECT_LT(damped, 0.25 * ours);
}

// The precision of the damping grows with the readings: twice as many a second leave the values as they are.
TEST(MachineErrorsOfAnArc, DampingIsByTheNumberOfReadings) {
  made::ErrorTest test = made::arc_220();
  test.errors = {{"straightness_b", 2.0}, {"scale_mismatch", 3.0}, {"backlash_a_pos", 2.0}, {"backlash_a_neg", -1.0}};
  const MachineErrors once = machine_errors(made::both_runs(test));
  test.readings_a_second *= 2.0;
  const MachineErrors twice = machine_errors(made::both_runs(test));
  for (const char* name : {"straightness_b", "scale_mismatch", "backlash_a_pos", "global_scale"}) {
    EXPECT_NEAR(*row_of(twice, name)->as_instrument, *row_of(once, name)->as_instrument, 0.03) << name;
  }
}

TEST(MachineErrorsOfAnArc, WhatTheInstrumentHoldsIsStated) {
  const MachineErrors found = machine_errors(made::both_runs(made::noisy(made::arc_220())));
  std::vector<std::string> stated;
  for (const PriorOfError& prior : found.prior) {
    stated.push_back(prior.name);
    EXPECT_GT(prior.sigma, 0.0) << prior.name;
    EXPECT_EQ(prior.unit, "um") << prior.name;
  }
  for (const char* name :
       {"centre_a", "radius_change", "offset_a_shift", "offset_b_shift", "scale_mismatch", "straightness_b",
        "(backlash_a_pos-backlash_a_neg)/2", "(lateral_play_b_pos-lateral_play_b_neg)/2"}) {
    EXPECT_NE(std::find(stated.begin(), stated.end(), name), stated.end()) << name;
  }
}

// On a full turn that the radii of both directions are alike, and nothing else.
TEST(MachineErrorsOfAFullTurn, WhatTheInstrumentHoldsIsStated) {
  const MachineErrors found = machine_errors(made::both_runs(made::noisy(made::full_turn())));
  ASSERT_EQ(found.prior.size(), 1U);
  EXPECT_EQ(found.prior.front().name, "radius_change");
}

std::vector<Recording> timed(std::vector<Recording> recordings, const made::ErrorTest& test) {
  for (Recording& recording : recordings) {
    const double interval_s = 2.0 * std::numbers::pi * test.radius_mm / (test.feed_mm_per_min / 60.0) /
                              static_cast<double>(recording.length_mm.size());
    for (std::size_t i = 0; i < recording.length_mm.size(); ++i) {
      recording.time_s.push_back(100.0 + interval_s * static_cast<double>(i));
    }
  }
  return recordings;
}

// Times say what the feed says.
TEST(MachineErrorsOfTimedReadings, AreThoseOfTheFeed) {
  const made::ErrorTest test = made::noisy(some_errors(made::full_turn()));
  const std::vector<Recording> stated = made::both_runs(test);
  const MachineErrors with_feed = machine_errors(stated), with_times = machine_errors(timed(stated, test));
  ASSERT_EQ(with_times.errors.size(), with_feed.errors.size());
  for (std::size_t k = 0; k < with_feed.errors.size(); ++k) {
    EXPECT_NEAR(with_times.errors[k].value, with_feed.errors[k].value, 1e-6) << with_feed.errors[k].name;
    EXPECT_NEAR(with_times.errors[k].sigma, with_feed.errors[k].sigma, 1e-6) << with_feed.errors[k].name;
  }
}

// Without a feed there is nothing to tell a delay by, all else is found; without times too, memories are in readings.
TEST(MachineErrorsWithoutFeed, HaveTheServoMismatchInUm) {
  const made::ErrorTest test = made::noisy(some_errors(made::full_turn()));
  std::vector<Recording> bare = made::both_runs(test);
  for (Recording& recording : bare) recording.feed_mm_per_min.reset();
  for (const MachineErrors& found : {machine_errors(bare), machine_errors(timed(bare, test))}) {
    EXPECT_EQ(found.errors.size(), 30U);
    for (const MachineError& row : found.errors) {
      const bool is_servo = row.name == "servo_mismatch";
      if (is_servo) {
        EXPECT_EQ(row.unit, "um");
      }
      const double truth = test.of(row.name) * (is_servo ? test.feed_mm_per_min / 60.0 : 1.0);
      EXPECT_NEAR(row.value, truth, 4.0 * row.sigma) << row.name;
      EXPECT_LT(row.sigma, row.unit == "um/m" ? 3.0 : 1.0) << row.name;
    }
  }
}

struct Refused {
  const char* name;
  std::function<void(std::vector<Recording>&)> spoil;
  const char* message;
};

void PrintTo(const Refused& refused, std::ostream* out) { *out << refused.name; }

class RefusedRecordings : public testing::TestWithParam<Refused> {};

TEST_P(RefusedRecordings, AreToldByTheirNumber) {
  std::vector<Recording> recordings = made::both_runs(made::full_turn());
  GetParam().spoil(recordings);
  try {
    machine_errors(recordings);
    ADD_FAILURE() << "not refused";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), GetParam().message);
  }
}

INSTANTIATE_TEST_SUITE_P(
    machine_errors, RefusedRecordings,
    testing::Values(
        Refused{"none", [](auto& all) { all.clear(); }, "expected recordings, found none."},
        Refused{"axial", [](auto& all) { all[1].kind = Kind::axial; },
                "recording 2: expected a circle, found an axial recording, which has no angles."},
        Refused{
            "rotary_axis", [](auto& all) { all[0].motion = Motion::rotary_axis; },
            "recording 1: expected a circle that two linear axes drive, whose errors these are, found rotary_axis."},
        Refused{"spindle", [](auto& all) { all[1].motion = Motion::spindle; },
                "recording 2: expected a circle that two linear axes drive, whose errors these are, found spindle."},
        Refused{"other_plane", [](auto& all) { all[1].plane = Plane::ZX; },
                "recording 2: expected the plane XY of the first, since each plane has errors of its own, found ZX."},
        Refused{"other_bar", [](auto& all) { all[1].nominal_length_mm = 100.0; },
                "recording 2: expected the bar of 150 mm of the first, found one of 100 mm."},
        Refused{"too_few",
                [](auto& all) {
                  all[1].length_mm.resize(119);
                  all[1].angle_rad.resize(119);
                },
                "recording 2: expected at least 120 readings, found 119."}),
    [](const auto& one) { return std::string(one.param.name); });

}  // namespace
}  // namespace ballbar
