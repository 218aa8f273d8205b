// Two tests of a machine, before and after: by how much each quantity differs, and what of that is clear.
//
//   d = after - before,  sigma_d = sqrt(sigma_before^2 + sigma_after^2),  p = 2 (1 - Phi(|d| / sigma_d))
//
// A difference is clear where it stands the correction for as many quantities as were looked at (Holm): of pairs of
// tests in which nothing changed, one in twenty has something clear at most. Sigma is that of the fits: two tests tell
// no scatter from set-up to set-up, nor what a warmer machine adds. Several tests before and after do (history.hpp).
//
// A value that a file stores has no sigma; whether it differs clearly is not known.
//
// Source: S. Holm, Scand. J. Stat. 6 (1979) 65-70.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "ballbar/history/machine_test.hpp"

namespace ballbar {

struct QuantityDifference {
  std::string name, unit;
  double before = std::numeric_limits<double>::quiet_NaN();  // NaN, as all below: the test has no such quantity
  double before_sigma = std::numeric_limits<double>::quiet_NaN();
  double after = std::numeric_limits<double>::quiet_NaN();
  double after_sigma = std::numeric_limits<double>::quiet_NaN();
  double difference = std::numeric_limits<double>::quiet_NaN();
  double sigma = std::numeric_limits<double>::quiet_NaN();
  double p_value = std::numeric_limits<double>::quiet_NaN();
  std::optional<bool> clear;  // nothing: not known
  bool shown = false;         // one of the tests shows it: by its fit, and beyond kSignificantSigmas
  bool of_set_up = false;     // where the bar was put: never clear
};

// What is clear of an error; of its ends that are, as of both sides of an axis, the one that differs most.
struct ClearChange {
  std::string name, unit;  // "backlash_a" of backlash_a_pos and backlash_a_neg
  double before = 0.0, after = 0.0;
};

struct TestComparison {
  MachineTest before, after;
  std::vector<TestCondition> differs;          // gaps are those of groups_of
  std::vector<QuantityDifference> quantities;  // circularity, what is clear by falling |d| / sigma_d, the rest
  std::size_t judged = 0;                      // quantities that p values are corrected for
};

// The clearest first. Without circularity and residual, which follow from the errors, and without the scales of the
// axes where another error is clear.
std::vector<ClearChange> clear_changes(const TestComparison& comparison);

// Throws Error for tests of two planes: these have no errors in common.
TestComparison compared_tests(const MachineTest& before, const MachineTest& after);

}  // namespace ballbar
