// What the diagnosis says of a made set, in types of the study: the one place that knows the interface of the core.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "ballbar/diagnosis/verdict/diagnose.hpp"
#include "made.hpp"

namespace ballbar::verdicts {

enum class Word { named, probable, driver, equivalent, unexplained, untestable, nothing };
std::string_view name_of(Word word);

struct Member {
  std::string effect;
  std::vector<std::string> columns;
  double p = 0.0;
};

struct SaidDriver {
  std::string column;
  double p = 0.0;
};

struct SaidOwn {
  std::string effect;  // label of the term
  std::string parameter;
  double held = 0.0, fitted = 0.0, p = 0.0;
};

// Of a parameter of a named effect.
struct SaidInterval {
  Member member;
  std::string parameter;
  double value = 0.0, low = 0.0, high = 0.0;  // 95 %
};

struct SaidOnset {
  Member member;
  double onset_s = 0.0;
};

struct Said {
  Word word = Word::nothing;
  std::vector<Member> named, probable;
  std::vector<std::vector<Member>> equivalent;
  std::vector<Member> effects;  // all that a probability is stated of
  std::vector<SaidDriver> drivers;
  std::vector<SaidOwn> own;
  std::vector<SaidInterval> intervals;
  std::vector<SaidOnset> onsets;  // of effects that begin at a moment
  double p_nothing = 0.0, p_discrepancy = 0.0;
  std::string sentence;
  double took_s = 0.0;
};

// Of the model's first target.
Said verdict_of(const Made& made);

// What a diagnosis said.
Said said_of(const Diagnosis& found);

}  // namespace ballbar::verdicts
