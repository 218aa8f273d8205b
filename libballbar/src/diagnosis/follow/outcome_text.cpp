#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "ballbar/diagnosis/follow/follow.hpp"
#include "ballbar/number_text.hpp"
#include "diagnosis/thresholds.hpp"

namespace ballbar {
namespace {

std::string place_of(const Look& look) {
  return fmt::format("after {}, at {} values", duration_text(3600.0 * look.hours), look.values);
}

std::string decided_label_text(const FollowState& state, const std::string& label) {
  double p = 0.0;
  for (const Hypothesis& one : state.looks[state.decided_at].hypotheses) p = one.label == label ? one.p : p;
  const bool is_own = label.find(" of ") < label.find('(');
  return fmt::format("{} ({})",
                     is_own ? fmt::format("the {} has another value", label) : fmt::format("{} is missing", label),
                     sure_text(p));
}

}  // namespace

std::string outcome_text(const FollowState& state) {
  if (state.looks.empty()) {
    return fmt::format("There are too few values: the first look is at {}.", kFirstLook);
  }
  const Look& last = state.looks.back();
  if (state.outcome == Outcome::decided) {
    std::vector<std::string> texts;
    texts.reserve(state.decided.size());
    for (const std::string& label : state.decided) texts.push_back(decided_label_text(state, label));
    return fmt::format("Decided {}: {}.", place_of(state.looks[state.decided_at]), fmt::join(texts, "; "));
  }
  if (state.outcome == Outcome::undecidable) {
    return fmt::format("Stop {}: this run will not decide. {}", place_of(last), last.why_stop);
  }
  if (!last.fault.empty()) return fmt::format("Not decided {}. {}", place_of(last), last.fault);
  const std::string best = last.hypotheses.empty()
                               ? ""
                               : fmt::format(" Best candidate: {} (probability {:.2f}).", last.hypotheses.front().label,
                                             last.hypotheses.front().p);
  return fmt::format("Not decided {}. Probability that nothing is missing: {:.2f}.{}{}{}", place_of(last),
                     last.p_nothing, best,
                     last.doubts.empty() ? "" : " Why it is not named: ", fmt::join(last.doubts, " "));
}

std::string error_text() {
  return fmt::format(
      "A run in which nothing is missing is decided wrongly in at most {:.0f} % of cases, however often you look, if "
      "noise and logging are as assumed. There are at most {} looks. At each, a decision needs readings that are "
      "{:.0f} "
      "times as likely with something missing as with nothing. A decided effect has a probability of {:.2f} or more "
      "and passes all tests at {} looks in a row.",
      100.0 * kFalselyDecided, kMostLooks, static_cast<double>(kMostLooks) / kFalselyDecided, 1.0 - kFalselyDecided,
      kLooksToDecide);
}

}  // namespace ballbar
