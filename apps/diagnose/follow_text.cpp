#include "diagnose/follow_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdio>
#include <vector>

#include "ballbar/diagnosis/thresholds.hpp"
#include "diagnose/follow_results.hpp"
#include "terminal/caller.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kHypotheses = 3;
constexpr double kLeastShown = 0.05;  // P

std::string hypotheses_text(const Look& look) {
  if (!look.fault.empty()) return "not diagnosed: " + look.fault;
  std::vector<std::string> texts;
  for (const Hypothesis& one : look.hypotheses) {
    if (texts.size() < kHypotheses && one.p >= kLeastShown) {
      texts.push_back(fmt::format("{:.2f} {}", one.p, one_line(one.label)));
    }
  }
  return texts.empty() ? "-" : fmt::format("{}", fmt::join(texts, ", "));
}

std::string_view word_of(Outcome outcome) { return outcome == Outcome::undecidable ? "stop" : name_of(outcome); }

}  // namespace

void print_follow_heading(const std::string& name, const std::string& target) {
  fmt::print("{}\n{}\n\n", name, target);
  fmt::print("{:>8}  {:>6}  {:>9}  {:>7}  {:<7}  {}\n", "hours", "values", "P nothing", "ln B", "state",
             "best candidates and their P");
  std::fflush(stdout);
}

void print_look(const FollowState& state, bool json) {
  const Look& look = state.looks.back();
  if (json) {
    print_json(json_of(Looked{look, state.outcome}), -1);
  } else {
    fmt::print("{:>8.2f}  {:>6}  {:>9.2f}  {:>7}  {:<7}  {}\n", look.hours, look.values, look.p_nothing,
               fixed(look.log_bayes_factor, 1), word_of(state.outcome), hypotheses_text(look));
  }
  std::fflush(stdout);
}

void print_outcome(const FollowState& state, const NextStep& next, bool json) {
  if (json) {
    print_json(
        json_of(Followed{state.outcome, state.decided, outcome_text(state), error_text(), next.command, next.hint}),
        -1);
    return;
  }
  fmt::print("{}{}", state.looks.empty() ? "" : "\n", wrapped(outcome_text(state)));
  if (!next.command.empty()) fmt::print("\n{}\n", next.command);
  if (!next.hint.empty()) fmt::print("\n{}", wrapped(next.hint));
  fmt::print("\n{}", wrapped(error_text() + " ln B: natural logarithm of that ratio. P: probability."));
}

}  // namespace ballbar
