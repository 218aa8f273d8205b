// What a diagnosis made of a data set.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "data_set.hpp"

namespace ballbar::study {

// What would be right.
enum class Expected {
  nothing,      // the verdicts nothing and untestable
  effects,      // all that is hidden is named, nothing else is, and nothing is left undecided
  unexplained,  // that verdict
  undecided     // nothing is named, and the truth is among what is reported
};

struct Said {
  bool right = false, wrong = false;
};

struct Outcome {
  Verdict verdict = Verdict::nothing;
  bool right = false;
  bool wrong = false;  // something is named that is not hidden; of `nothing`: any verdict but nothing and untestable;
                       // of `undecided`: anything is named
  std::optional<bool> in_set;     // all that is hidden is named or among what is reported
  bool called = false;            // any verdict but nothing and untestable
  std::optional<bool> fake;       // temperature: one is named, where there are any
  std::optional<bool> separable;  // oracle.hpp, as the next two
  std::optional<double> loss;
  std::string competitor;
  std::optional<std::array<Said, 4>> baselines;
  // Of the rightly named: amplitude within 25 %, time constants within 35 %, in the 95 % interval.
  std::vector<bool> amplitude, time_constant, covered;
  // RMSE after adding what is named, and the first of what is left undecided, over that of the noise; and on another
  // duty cycle over that of the true model, fitted to the same data.
  std::optional<double> training, other_duty;
};

Outcome judged(const DataSet& set, const Diagnosis& found, Expected expected);

struct Besides {
  bool baselines = true;
  bool errors = false;  // on another duty cycle of the rich record
};

// And held against the oracle where something is hidden; printed where every data set is.
Outcome judged_and_weighed(const DataSet& set, const Diagnosis& found, Expected expected);

// Diagnosed first.
Outcome examined(const DataSet& set, Expected expected, const Besides& besides = {});

void print(const DataSet& set, const Diagnosis& found, const Outcome& outcome);

// With VERBOSE in the environment every data set is printed.
bool is_verbose();

}  // namespace ballbar::study
