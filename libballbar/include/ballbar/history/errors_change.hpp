// What changed between two tests of a machine, before and after a repair, an adjustment or a collision: the difference
// of each quantity and its significance.
//
//   d = after - before,  sigma_d = sqrt(sigma_before^2 + sigma_after^2),  p = 2 (1 - Phi(|d| / sigma_d))
//
// A difference is "clear" if it is significant after Holm's correction for the number of quantities. Of pairs of tests
// without any change at most one in twenty has a clear difference. Sigma is that of the fits. Two tests cannot show the
// scatter between set-ups or the influence of a warmer machine; several tests before and after can (history.hpp).
//
// Units are those of the quantity: um, um/m, ms, ppm. Signs: positive is a larger value after. A quantity that follows
// from others (circularity, residual, the scales beside another error) is listed and is no change of its own.
//
// Stored values have no sigma, so that the significance of their differences is not known. Conditions that differ
// (feed, bar, arc, directions) are listed in `differs`: a difference may then be theirs.
//
// Source: S. Holm, Scand. J. Stat. 6 (1979) 65-70.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "ballbar/history/history.hpp"

namespace ballbar {

struct QuantityDifference {
  std::string name, unit;
  double before = std::numeric_limits<double>::quiet_NaN();  // NaN here and below: the test lacks the quantity
  double before_sigma = std::numeric_limits<double>::quiet_NaN();
  double after = std::numeric_limits<double>::quiet_NaN();
  double after_sigma = std::numeric_limits<double>::quiet_NaN();
  double difference = std::numeric_limits<double>::quiet_NaN();
  double sigma = std::numeric_limits<double>::quiet_NaN();
  double p_value = std::numeric_limits<double>::quiet_NaN();
  std::optional<bool> clear;  // nullopt: not known
  bool shown = false;         // significant in one of the tests: by its fit, and beyond kSignificantSigmas
  bool of_set_up = false;     // describes the position of the bar; never clear
};

// A clear change of an error. For an error with two ends, the end with the larger difference.
struct ClearChange {
  std::string name, unit;  // "backlash_a" of backlash_a_pos and backlash_a_neg
  double before = 0.0, after = 0.0;
};

struct TestComparison {
  MachineTest before, after;
  std::vector<TestCondition> differs;          // with the tolerances of TestGroup
  std::vector<QuantityDifference> quantities;  // circularity, then clear ones by falling |d| / sigma_d, then the rest
  std::size_t judged = 0;                      // number of quantities in the correction
};

// The clear changes, the most significant first. Circularity and residual are left out because they follow from the
// errors, the scales of the axes if another error is clear.
std::vector<ClearChange> clear_changes(const TestComparison& comparison);

// Throws Error for tests of different planes, which have no common errors.
TestComparison compared_tests(const MachineTest& before, const MachineTest& after);

}  // namespace ballbar
