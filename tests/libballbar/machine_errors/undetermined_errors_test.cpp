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

// Below 60 deg all errors look alike.
TEST(UndeterminedErrors, ShortestArc) {
  made::ErrorTest test = made::noisy(made::full_turn());
  test.arc_deg = 40.0;
  try {
    machine_errors(made::both_runs(test));
    ADD_FAILURE() << "not refused";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(),
                 "expected an arc of at least 60 deg, on less the errors of the axes look alike, found 40 deg.");
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
