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
  return fmt::format("{}, {}",
                     is_own ? fmt::format("the {} is another one", label) : fmt::format("{} is missing", label),
                     sure_text(p));
}

}  // namespace

std::string outcome_text(const FollowState& state) {
  if (state.looks.empty()) {
    return fmt::format("There are too few values to look at: the first look is at {}.", kFirstLook);
  }
  const Look& last = state.looks.back();
  if (state.outcome == Outcome::decided) {
    std::vector<std::string> texts;
    texts.reserve(state.decided.size());
    for (const std::string& label : state.decided) texts.push_back(decided_label_text(state, label));
    return fmt::format("Decided {}: {}.", place_of(state.looks[state.decided_at]), fmt::join(texts, "; "));
  }
  if (state.outcome == Outcome::undecidable) {
    return fmt::format("Stop, it will not be decided in this run, {}. {}", place_of(last), last.why_stop);
  }
  if (!last.fault.empty()) return fmt::format("Not decided {}. {}", place_of(last), last.fault);
  const std::string best = last.hypotheses.empty()
                               ? ""
                               : fmt::format(", the most probable is {} with {:.2f}", last.hypotheses.front().label,
                                             last.hypotheses.front().p);
  return fmt::format("Not decided {}: P of nothing is {:.2f}{}.{}{}", place_of(last), last.p_nothing, best,
                     last.doubts.empty() ? "" : " It is not named: ", fmt::join(last.doubts, " "));
}

std::string error_text() {
  return fmt::format(
      "However often it is looked at, a run in which nothing is missing comes to a decision in at most {:.0f} % of "
      "cases, as far as noise and logging are what they are taken for: at each of at most {} looks the readings must "
      "be "
      "{:.0f} times as likely with something missing as with nothing. What is decided has P of {:.2f} or more, by all "
      "tests, at {} looks in a row.",
      100.0 * kFalselyDecided, kMostLooks, static_cast<double>(kMostLooks) / kFalselyDecided, 1.0 - kFalselyDecided,
      kLooksToDecide);
}

}  // namespace ballbar
