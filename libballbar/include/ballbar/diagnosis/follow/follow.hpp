// Diagnosis of a run that is still growing. The outcome is decided, open, or undecidable in this run.
//
// A run is diagnosed ("a look") at 64 values of its target, and again whenever the number has grown by a twelfth. The
// looks depend on the data alone, not on when or how often somebody asks. Many looks must not raise the rate of false
// decisions. Two bounds hold for all looks together:
//
// No effect is missing. Let B be the Bayes factor of something missing against nothing missing
// (Diagnosis::log_bayes_factor). If nothing is missing, the mean of B is at most 1 at each look. By Markov's inequality
// B >= 5000 then occurs in at most one of 5000 runs at one look, and in at most 100 / 5000 = 2 % of runs at any of 100
// looks. The looks may depend on each other, and priors may change from look to look.
//
// Another effect is missing. A posterior does not depend on the stopping rule: a decision at P >= 0.98 names the wrong
// effect in at most 2 % of runs.
//
// Both bounds assume that the likelihood is right; tests/study/verdicts/follow.cpp counts the errors. An effect is
// decided when, at three looks in a row, all tests name it, P >= 0.98 and B >= 5000.
//
// A run is undecidable in two cases. First: at three looks in a row "nothing missing" is improbable and two rivals are
// alike. Rivals are alike if they read the same values under two column names, or if ln of the odds between the first
// and another one with P >= 0.1 moved by less than 0.2 while the number of values doubled. Second: the planned end is
// known, half of the planned time is over, and ln B or ln of the odds of the first against all others will not reach
// its threshold by the end. With v the value now, D the gain since the run had half of the values, and f the remaining
// time divided by the time since then, the value at the end is forecast as at most
//
//   v + f D + 2 sqrt((f^2 + f) (2 D + 1)),
//
// because ln of odds that grow by D has a variance of 2 D. The forecast misses an effect that acts only later.
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

// Number of target values at which look k = 0, 1 ... kMostLooks - 1 takes place.
std::size_t values_of_look(std::size_t look);

// The rows up to and with the given number of target values; all rows if there are fewer.
Series first_rows(const Series& data, const std::string& target, std::size_t values);

// Maps each column that repeats the values of an earlier column to the name of that earlier column.
std::map<std::string, std::string> columns_logged_twice(const Series& data);

std::string label_of(const OwnValue& own);  // "exponent of speed_heating(speed_rpm)"

// An effect with the probability that it is missing, or a held value with the probability that it is wrong.
struct Hypothesis {
  std::string label;
  double p = 0.0;
  std::string once = {};  // label in which a column that is logged twice has the name of the first
};

struct Look {
  std::size_t values = 0;  // of the target
  double hours = 0.0;      // from the first row to the last
  Verdict verdict = Verdict::untestable;
  double p_nothing = 1.0;
  double log_bayes_factor = 0.0;
  std::vector<Hypothesis> hypotheses;  // sorted, the most probable first
  std::vector<std::string> sure;       // labels that count towards a decision
  std::vector<std::string> doubts;     // sentences: why another label of the same probability does not count
  std::string why_stop;                // sentence: why the run is undecidable; empty: it may still be decided
  std::string fault;                   // sentence: why the diagnosis failed; empty: it succeeded
};

enum class Outcome { open, decided, undecidable };
std::string_view name_of(Outcome outcome);

struct FollowState {
  std::optional<double> planned_hours;              // nullopt: no forecast of the end
  std::map<std::string, std::string> logged_twice;  // columns_logged_twice(); an effect that reads one stays undecided
  std::vector<Look> looks;
  Outcome outcome = Outcome::open;   // never changes back from decided
  std::vector<std::string> decided;  // labels of the decided effects
  std::size_t decided_at = 0;        // index into looks
};

// The state after one more look. The diagnosis is that of the first values_of_look(state.looks.size()) values.
FollowState followed(FollowState state, const Diagnosis& diagnosis, std::size_t values, double hours);

// The state after a look at which the diagnosis failed with this fault.
FollowState followed(FollowState state, const std::string& fault, std::size_t values, double hours);

// Whole sentences: what is decided, why the run is undecidable, or how far it is from a decision.
std::string outcome_text(const FollowState& state);

// One sentence: the bound on the rate of false decisions.
std::string error_text();

}  // namespace ballbar
