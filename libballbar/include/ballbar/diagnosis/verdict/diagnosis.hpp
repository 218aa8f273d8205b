// Which physical effect a model lacks - or that the data cannot tell.
//
// A falling error proves fit, not cause: on records with a memory a random smooth signal also lowers it. So what is
// missing is taken as a sum of single effects, each of which is nothing, one effect of the catalogue, an input of any
// form, or a value that the model holds at another one; beside them noise with a memory, a slow discrepancy, and a
// little of every input. Gains, shapes and noise are integrated out, inputs are late and rounded as loggers make them
// (src/diagnosis/README.md). An effect is named where P >= 0.9 and no doubt holds: its gain differs from cycle to
// cycle, cycles left out are not predicted better, it goes with time alone, it makes the readings hardly more likely.
// One that fails is no longer named; the others stay.
//
// P holds inside the catalogue (tests/study/verdicts).
//
// On recordings a cycle is a recording, of one alone a quarter of its sweep. What surrogates say of an effect is told
// (candidate.hpp), and does not decide.
//
// Of more than 1000 values of the target every second, third ... is weighed, and all about a jump that is found;
// figures of the effects are of those.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/diagnosis/posterior/search_options.hpp"
#include "ballbar/diagnosis/signatures/identifiability.hpp"
#include "ballbar/diagnosis/verdict/candidate.hpp"
#include "ballbar/fit/fit.hpp"
#include "ballbar/fit/residual.hpp"
#include "ballbar/model/bound_effect.hpp"
#include "ballbar/model/model.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

enum class Verdict {
  named,        // this effect, or a value that the model holds
  probable,     // likewise, P >= 0.8
  driver,       // this input, its form is open
  equivalent,   // something is missing, it may be one of these
  unexplained,  // something is missing: a slow drift, what goes with time alone, or no effect that is likely
  untestable,   // the data could not have shown it
  nothing,      // no effect
};
std::string_view name_of(Verdict verdict);

struct EffectProbability {
  BoundEffect bound;
  double p = 0.0;
};

// That this column drives something that is missing, whatever its form.
struct Driver {
  std::string column;
  double p = 0.0;
};

// That a value which the model holds is another one.
struct OwnValue {
  std::string effect;           // label of the term
  std::string parameter, unit;  // "exponent", "1"
  double held = 0.0, fitted = 0.0;
  Interval interval;  // of fitted
  double p = 0.0;
};

// A gain of the model, or of the best set, that is another one from run to run: a machine that changed.
struct GainByRun {
  std::string effect;               // label
  std::string parameter, unit;      // "gain_um_per_K", "um/K"
  double p = 1.0;                   // of chances that say so if it were one
  std::vector<double> gain, sigma;  // of each run
};

struct Diagnosis {
  std::string target;
  Fit base;
  Verdict verdict = Verdict::nothing;
  std::vector<BoundEffect> named, probable;
  std::vector<std::vector<BoundEffect>> equivalent;  // each: effects of which one is it, the most probable first
  std::vector<Driver> drivers;                       // from P = 0.5, the most probable first
  std::vector<OwnValue> own;                         // from P = 0.05
  std::vector<EffectProbability> effects;            // from P = 0.01
  std::vector<GainByRun> gains_by_run;               // of several runs, those that differ
  double p_nothing = 1.0;                            // no effect, no other value, no discrepancy
  double p_discrepancy = 0.0;
  // ln of how much more likely the readings are with any effect or other value than with none, whatever the
  // discrepancy: its exponential is at most 1 on average where none is hidden.
  double log_bayes_factor = 0.0;
  double discrepancy_um = 0.0;        // its standard deviation, where it is most likely; at most half of what the
                                      // readings span
  Noise noise;                        // beside the best set
  std::vector<Candidate> candidates;  // the best set first, then by P; at most 12
  // Largest less smallest of what the best set adds together; at most that of the readings, because more than that is
  // cancelled by the model's own effects.
  double explained_um = 0.0;
  // Amplitude up to which an effect that blind challenges hide could be there: that which shows worst, in the middle of
  // its shapes; at most what the readings span.
  double hidden_um = 0.0;
  BoundEffect hidden;          // that effect
  double rmse_after_um = 0.0;  // with the best set
  std::size_t searched_effects = 0;
  std::vector<Detectability> detectability;  // what the data could show, as preflight
  std::vector<std::string> reasons;          // why not `named`; whole sentences
  std::string where;                         // "while warming": where the model fails most, as the options have it
  std::string sentence;                      // the verdict in plain words, the first without any of statistics
};

struct DiagnosisOptions {
  SearchOptions search;
  double tolerance_um = 0.0;  // smaller effects are called minor
  std::size_t surrogates = kSurrogates;
  std::size_t most_rows = 1000;  // values of the target weighed
  bool fit_candidates = true;    // Candidate::rmse_after_um
  std::string where = {};        // worst_place(), which the sentence tells
};

// Throws Error as fit does.
Diagnosis diagnose(const Model& model, const Series& data, std::size_t target = 0,
                   const DiagnosisOptions& options = {});

}  // namespace ballbar
