// What `diagnose --follow --json` prints: a line a look, and one at the end; and what a diagnosis says while it goes
// on.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ballbar/diagnosis/follow/follow.hpp"
#include "ballbar/formats/results/result_type.hpp"

namespace ballbar {

template <>
struct ResultType<Hypothesis> {
  static constexpr std::string_view name = "Hypothesis";
  static constexpr std::string_view meaning = "What may be missing.";
  static constexpr std::tuple fields{Field{"label", &Hypothesis::label, "the effect with its columns"},
                                     Field{"p", &Hypothesis::p, "probability"}};
};

struct PosteriorSoFar {
  std::vector<Hypothesis> posterior;
};

template <>
struct ResultType<PosteriorSoFar> {
  static constexpr std::string_view name = "SoFar";
  static constexpr std::string_view meaning = "What a diagnosis says while it goes on.";
  static constexpr std::tuple fields{Field{"posterior", &PosteriorSoFar::posterior, "the most probable first"}};
};

struct Looked {
  Look look;
  Outcome outcome = Outcome::open;
};

template <>
struct ResultType<Looked> {
  using Of = const Looked&;
  static constexpr std::string_view name = "Looked";
  static constexpr std::string_view meaning = "What a run that is still measured says so far.";
  static constexpr std::tuple fields{
      Field{"hours", [](Of of) { return of.look.hours; }, "from the first row to the last"},
      Field{"values", [](Of of) { return of.look.values; }, "of the target"},
      Field{"verdict", [](Of of) { return of.look.fault.empty() ? std::optional(of.look.verdict) : std::nullopt; },
            "as of diagnose; null: not diagnosed"},
      Field{"p_nothing", [](Of of) { return of.look.p_nothing; }, "probability that nothing is missing"},
      Field{"log_bayes_factor", [](Of of) { return of.look.log_bayes_factor; },
            "ln of anything that is missing against nothing"},
      Field{"hypotheses", [](Of of) { return of.look.hypotheses; }, "the most probable first"},
      Field{"outcome", &Looked::outcome, "open, decided, undecidable"},
      Field{"why_stop", [](Of of) { return of.look.why_stop; }, "empty: it may be decided yet"},
      Field{"fault", [](Of of) { return of.look.fault; }, "why there is no diagnosis; empty: there is"}};
};

struct Followed {
  Outcome outcome = Outcome::open;
  std::vector<std::string> decided;
  std::string sentence, error, command, hint;
};

template <>
struct ResultType<Followed> {
  static constexpr std::string_view name = "Followed";
  static constexpr std::string_view meaning = "How a run that was followed came out.";
  static constexpr std::tuple fields{Field{"outcome", &Followed::outcome, "open, decided, undecidable"},
                                     Field{"decided", &Followed::decided, "effects that are missing"},
                                     Field{"sentence", &Followed::sentence, "what it says in plain words"},
                                     Field{"error", &Followed::error, "how often it errs"},
                                     Field{"command", &Followed::command, "to type next; empty: none"},
                                     Field{"hint", &Followed::hint, "what no command does; empty: nothing"}};
};

}  // namespace ballbar
