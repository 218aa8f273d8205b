// What readings do not tell has a sigma that says so: short arcs, and one direction alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "ballbar/error.hpp"
#include "ballbar/machine_errors/machine_errors.hpp"
#include "made_errors.hpp"

namespace ballbar {
namespace {

// There some errors are the sum of others, with no digit between them: all the less is known of each.
TEST(UndeterminedErrors, ShortArcsHaveSigmas) {
  for (const double arc_deg : {70.0, 80.0, 90.0, 180.0}) {
    for (const double first_deg : {0.0, 20.0, 45.0}) {
      for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        made::ErrorTest test = made::noisy(made::full_turn());
        test.radius_mm = 100.0;
        test.first_deg = first_deg;
        test.arc_deg = arc_deg;
        const MachineErrors found = machine_errors(made::both_runs(test, seed));
        for (const MachineError& row : found.errors) {
          EXPECT_GT(row.sigma, 0.005) << row.name << ", " << arc_deg << " deg from " << first_deg;
        }
        for (const PriorOfError& prior : found.prior) EXPECT_GT(prior.sigma, 0.05) << prior.name;
      }
    }
  }
}

// D is the same all the way: servo mismatch and squareness are one curve, of which the sum alone is known.
TEST(UndeterminedErrors, OneDirectionTellsNotSquarenessFromServoMismatch) {
  made::ErrorTest test = made::noisy(made::full_turn());
  test.errors = {{"squareness", 30.0}};
  const std::vector<Recording> runs = made::both_runs(test);
  for (const Recording& run : runs) {
    const MachineErrors found = machine_errors(std::vector{run});
    const auto sigma_of = [&](const std::string& name) {
      const auto row = std::find_if(found.errors.begin(), found.errors.end(),
                                    [&](const MachineError& one) { return one.name == name; });
      return row == found.errors.end() ? 0.0 : row->sigma;
    };
    EXPECT_GT(sigma_of("squareness"), 100.0);
    EXPECT_GT(sigma_of("servo_mismatch"), 1.0);
    for (const RankedError& one : found.ranked) {
      if (one.significant) ADD_FAILURE() << one.effect->name << " of one direction";
    }
  }
}

// Four waves along the travel of both axes are nearly circle and straightness: what is read of each where its own axis
// shows, 12 to 63 deg after a reversal, does not tell them apart. Then they stay near 0 and spoil nothing else.
TEST(UndeterminedErrors, LongWavesOfBothAxesSpoilNothing) {
  struct Case {
    double radius_mm, pitch_mm;
  };
  for (const auto& [radius_mm, pitch_mm] : {Case{100.0, 50.0}, Case{50.0, 25.0}, Case{50.0, 30.0}}) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      made::ErrorTest test = made::noisy(made::full_turn());
      test.radius_mm = radius_mm;
      test.pitch_a_mm = test.pitch_b_mm = pitch_mm;
      test.errors = {{"centre_a", 9.0},
                     {"centre_b", -4.0},
                     {"scale_mismatch", 8.0},
                     {"backlash_a_pos", 3.7},
                     {"backlash_a_neg", 3.7}};
      const MachineErrors found = machine_errors(made::both_runs(test, seed));
      const std::string of = std::to_string(radius_mm) + " mm, seed " + std::to_string(seed);
      for (const MachineError& row : found.errors) {
        if (row.name.starts_with("centre")) {
          EXPECT_NEAR(row.value, test.of(row.name), 0.4) << row.name << ", " << of;
        }
        if (row.name.starts_with("straightness") || row.name.starts_with("cyclic")) {
          EXPECT_NEAR(row.value, 0.0, 2.5) << row.name << ", " << of;
        }
      }
      for (const AddedError& added : found.one_by_one) {
        EXPECT_LT(found.residual_rms_um, 1.001 * added.rms_um) << added.effect->name << ", " << of;
      }
      EXPECT_NE(std::find(found.undetermined.begin(), found.undetermined.end(), "cyclic_error_a with cyclic_error_b"),
                found.undetermined.end())
          << of;
    }
  }
}

// One such axis alone is told, with the amplitude that it has.
TEST(UndeterminedErrors, LongWavesOfOneAxisAreFound) {
  made::ErrorTest test = made::noisy(made::full_turn());
  test.radius_mm = 100.0;
  test.pitch_a_mm = 50.0;
  test.errors = {{"cyclic_error_a_fwd", 6.0}, {"cyclic_error_a_rev", 6.0}};
  const MachineErrors found = machine_errors(made::both_runs(test));
  for (const MachineError& row : found.errors) {
    if (!row.name.starts_with("cyclic_error_a")) continue;
    EXPECT_NEAR(row.value, 6.0, 1.0) << row.name;
  }
  for (const std::string& phrase : found.undetermined) EXPECT_EQ(phrase.find("cyclic"), std::string::npos) << phrase;
}

// Below 60 deg all errors look alike.
TEST(UndeterminedErrors, ShortestArc) {
  made::ErrorTest test = made::noisy(made::full_turn());
  test.arc_deg = 40.0;
  try {
    machine_errors(made::both_runs(test));
    ADD_FAILURE() << "not refused";
  } catch (const Error& error) {
    EXPECT_STREQ(
        error.what(),
        "an arc of 40 deg is too short for the errors of the axes: expected at least 60 deg, below which they look "
        "alike. ballbar fit gives the circle.");
  }
}

// From 45 to 135 deg only B reverses, at its + end: the far tails of the other spikes are no rows.
TEST(UndeterminedErrors, SpikesOfReversalsOutsideTheArcAreNoRows) {
  made::ErrorTest test = made::noisy(made::full_turn());
  test.first_deg = 45.0;
  test.arc_deg = 90.0;
  std::vector<std::string> spikes;
  for (const MachineError& row : machine_errors(made::both_runs(test)).errors) {
    if (row.name.starts_with("reversal_spike")) spikes.push_back(row.name);
  }
  EXPECT_EQ(spikes, std::vector<std::string>{"reversal_spike_b_pos"});
}

}  // namespace
}  // namespace ballbar
