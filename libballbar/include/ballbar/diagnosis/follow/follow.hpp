// A run that is diagnosed while it goes on: what is missing is decided, open, or will stay open in this run.
//
// A run is looked at when its target has 64 values, and again whenever it has a twelfth more: the same looks wherever
// one begins to watch, and as many whether it is asked for them after each row or once a day. To look often must not
// say more that is false. Two bounds hold for all looks together:
//
// Nothing is hidden. Let B be how much more likely the readings are with something than with nothing
// (Diagnosis::log_bayes_factor). Where nothing is hidden its mean is at most 1 at each look, so that B >= 5000 in at
// most one of 5000 runs at a look (Markov), and in at most 100 / 5000 = 2 % of runs at any of 100 looks. No more is
// asked of the looks: they may depend on each other, and priors may change from one to the next.
//
// Something else is hidden. A posterior does not depend on why one stopped: what is decided at P >= 0.98 is another
// effect in at most 2 % of runs.
//
// That is so as far as the likelihood is right; tests/study/verdicts/follow.cpp counts it. Decided is what at three
// looks in a row is named by all tests, of P >= 0.98, with B >= 5000.
//
// It will not be decided in this run, where at three looks in a row nothing is improbable and two rivals are alike:
// they read the same values under two names, or the odds of the first and of another one, of P >= 0.1, moved by less
// than 0.2 of their ln while the values doubled. Or, where the planned end is known and half of that time is over, ln B
// or ln of the odds of the first against all others would not come far enough by then. With v now, D gained since there
// were half of the values, and f the time that is left over the time since then, it comes to at most
//
//   v + f D + 2 sqrt((f^2 + f) (2 D + 1)):
//
// ln of odds that grow by D has a variance of 2 D. An effect that acts later only is not foreseen.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/diagnosis/verdict/diagnosis.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

// Values of the target at look k = 0, 1 ... kMostLooks - 1.
std::size_t values_of_look(std::size_t look);

// The rows up to that value of the target; all where there are fewer.
Series first_rows(const Series& data, const std::string& target, std::size_t values);

// Columns that hold the same values as an earlier one, which is the second name.
std::map<std::string, std::string> columns_logged_twice(const Series& data);

std::string label_of(const OwnValue& own);  // "exponent of speed_heating(speed_rpm)"

// An effect, or a value that the model holds, and P that it is missing or another.
struct Hypothesis {
  std::string label;
  double p = 0.0;
  std::string once = {};  // label, columns that are logged twice by the name of the first
};

struct Look {
  std::size_t values = 0;  // of the target
  double hours = 0.0;      // from the first row to the last
  Verdict verdict = Verdict::untestable;
  double p_nothing = 1.0;
  double log_bayes_factor = 0.0;
  std::vector<Hypothesis> hypotheses;  // the most probable first
  std::vector<std::string> sure;       // labels that count towards a decision
  std::vector<std::string> doubts;     // why what is as sure is not among them, sentences
  std::string why_stop;                // a sentence; empty: it may be decided yet
  std::string fault;                   // why there is no diagnosis, a sentence; empty: there is
};

enum class Outcome { open, decided, undecidable };
std::string_view name_of(Outcome outcome);

struct FollowState {
  std::optional<double> planned_hours;              // without: no end is forecast
  std::map<std::string, std::string> logged_twice;  // columns_logged_twice: what reads one of them is not decided
  std::vector<Look> looks;
  Outcome outcome = Outcome::open;   // decided stays
  std::vector<std::string> decided;  // labels
  std::size_t decided_at = 0;        // of looks
};

// After one more look; the diagnosis is of values_of_look(state.looks.size()) values.
FollowState followed(FollowState state, const Diagnosis& diagnosis, std::size_t values, double hours);

// The same where these values could not be diagnosed.
FollowState followed(FollowState state, const std::string& fault, std::size_t values, double hours);

// What is decided, why it will not be, or how far it is; whole sentences.
std::string outcome_text(const FollowState& state);

// The bound on what is falsely decided, a sentence.
std::string error_text();

}  // namespace ballbar
