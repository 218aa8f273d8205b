// What a diagnosis found, for the message of a test that fails.
#pragma once

#include <fmt/format.h>

#include <string>

#include "ballbar/diagnosis/verdict/diagnose.hpp"

namespace ballbar::made {

// The verdict and the best set: "named step() (P 0.99, 0 doubts); P(nothing) 0.00, P(discrepancy) 0.12".
inline std::string outcome_of(const Diagnosis& found) {
  std::string text(name_of(found.verdict));
  for (const Candidate& one : found.candidates) {
    if (one.in_best_set) text += fmt::format(" {} (P {:.2f}, {} doubts)", one.label, one.p, one.doubts.size());
  }
  return fmt::format("{}; P(nothing) {:.2f}, P(discrepancy) {:.2f}", text, found.p_nothing, found.p_discrepancy);
}

}  // namespace ballbar::made
