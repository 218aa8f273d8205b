// What is said, from the posterior and the tests of its members.
#pragma once

#include <vector>

#include "ballbar/diagnosis/verdict/diagnose.hpp"

namespace ballbar {

struct Evidence {
  std::vector<Candidate> members;                      // of the best set, tested
  std::vector<std::vector<BoundEffect>> alternatives;  // of each: the credible set of its single effect
  std::vector<Driver> drivers;
  std::vector<OwnValue> held;  // values held in the model
  double p_nothing = 1.0;
  bool is_drift_beside = false;       // a slow drift without a cause
  bool is_all_searched = true;        // else another cause may be among the columns that were not
  bool has_level_jumps = false;       // of the target
  bool has_unexplained_rest = false;  // more than the readings scatter, as far as their sigma is known
};

struct Statement {
  Verdict verdict = Verdict::nothing;
  std::vector<BoundEffect> named, probable;
  std::vector<std::vector<BoundEffect>> equivalent;
};

// The first verdict that applies.
Statement statement_of(const Evidence& evidence);

}  // namespace ballbar
