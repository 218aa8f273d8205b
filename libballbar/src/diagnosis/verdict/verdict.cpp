#include "diagnosis/verdict/verdict.hpp"

#include <algorithm>
#include <utility>

#include "ballbar/diagnosis/signatures/search.hpp"

namespace ballbar {
namespace {

// Whether no possibly missing effect reads a column.
bool is_of_time_alone(const std::vector<std::vector<BoundEffect>>& equivalent) {
  return std::all_of(equivalent.begin(), equivalent.end(), [](const std::vector<BoundEffect>& group) {
    return std::all_of(group.begin(), group.end(), [](const BoundEffect& one) { return one.effect->time_only; });
  });
}

// Whether a larger slow drift without a cause is beside a member that the readings hardly need.
bool is_part_of_drift(const Candidate& one) {
  const auto has = [&](Doubt doubt) {
    return std::find(one.doubts.begin(), one.doubts.end(), doubt) != one.doubts.end();
  };
  return has(Doubt::weak_evidence) && has(Doubt::larger_drift);
}

}  // namespace

Statement statement_of(const Evidence& evidence) {
  Statement result;
  if (evidence.p_nothing >= kNothing && !evidence.has_level_jumps) {
    result.verdict = evidence.has_unexplained_rest ? Verdict::unexplained : Verdict::nothing;
    return result;
  }
  for (std::size_t m = 0; m < evidence.members.size(); ++m) {
    const Candidate& one = evidence.members[m];
    if (one.doubts.empty() && one.p >= kNamed && evidence.is_all_searched) {
      result.named.push_back(one.bound);
    } else if (one.doubts.empty() && one.p >= kProbable) {
      result.probable.push_back(one.bound);
    } else if (!one.other_form_likelier && !is_part_of_drift(one)) {
      std::vector<BoundEffect> group = evidence.alternatives[m];
      if (std::find(group.begin(), group.end(), one.bound) == group.end()) group.push_back(one.bound);
      if (std::find(result.equivalent.begin(), result.equivalent.end(), group) == result.equivalent.end())
        result.equivalent.push_back(std::move(group));
    }
  }
  const bool is_clear = !evidence.is_drift_beside && evidence.is_all_searched;
  const auto is_held_value = [&](double p) {
    return is_clear &&
           std::any_of(evidence.held.begin(), evidence.held.end(), [p](const OwnValue& one) { return one.p >= p; });
  };
  const bool has_driver = std::any_of(evidence.drivers.begin(), evidence.drivers.end(),
                                      [](const Driver& one) { return one.p >= kSureDriver && one.is_clear; });
  if (!result.named.empty() || is_held_value(kNamed)) {
    result.verdict = Verdict::named;
  } else if (!result.probable.empty() || is_held_value(kProbable)) {
    result.verdict = Verdict::probable;
  } else if (has_driver) {
    result.verdict = Verdict::driver;
  } else {
    result.verdict = is_of_time_alone(result.equivalent) ? Verdict::unexplained : Verdict::equivalent;
  }
  return result;
}

}  // namespace ballbar
