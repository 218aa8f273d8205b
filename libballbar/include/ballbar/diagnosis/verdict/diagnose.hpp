// Which physical effect is missing from a model, or that the data cannot say.
//
//   const Diagnosis found = diagnose(model, data);
//   found.verdict      named, probable, driver, equivalent, unexplained, untestable, nothing
//   found.named        the effects; found.candidates has their parameters, evidence and doubts
//
// A smaller error does not prove a cause: if the noise is correlated, a random smooth signal lowers the error too. The
// missing part is therefore modelled as a sum of single effects (SuSiE; Wang, Sarkar, Carbonetto and Stephens 2020,
// J. R. Stat. Soc. B 82, 1273). Each of them is nothing, one effect of the catalogue, an input in any form, or a wrong
// held value of the model. To these come correlated noise and a slow discrepancy. Gains and shapes are integrated out,
// the noise is the likeliest; inputs may be delayed and rounded, as loggers do (src/diagnosis/README.md).
//
// An effect is named if P >= 0.9 and no doubt holds: its gain differs from cycle to cycle; it does not improve the
// prediction of left-out cycles; a larger discrepancy is beside it; it hardly raises the likelihood of the readings. A
// doubt affects its own effect only. P is the probability within the catalogue (tests/study/verdicts): for other
// physics the verdict relies on the discrepancy, the inputs in any form and the gains of the cycles.
//
// On recordings a cycle is one recording, or a quarter of the sweep of a single recording. Of more than 1000 values of
// the target only every second, third ... is used, and all values near a detected jump. The figures of the effects
// refer to these values.
//
// Accuracy: on simulated logs of nine kinds of logging one name of 36 is wrong; over all cells of the study, those with
// causes outside the catalogue among them, 63 of 564 (tests/study/README.md).
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/diagnosis/signatures/search.hpp"
#include "ballbar/fit/fit.hpp"
#include "ballbar/model/model.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

// ---- A candidate: one effect with its probability and the results of its tests.

// A 95 % credible interval of a number; NaN: not known.
struct Interval {
  double low = std::numeric_limits<double>::quiet_NaN();
  double high = std::numeric_limits<double>::quiet_NaN();
};

// Why an effect is not named, or not supported where it was added.
enum class Doubt {
  time_alone,        // it reads no column: any slow drift looks like it
  gain_differs,      // its gain differs between cycles, or recordings
  not_predictive,    // it does not improve the prediction of left-out cycles, or recordings
  weak_evidence,     // its likelihood ratio is below kLeastLikelihoodRatio
  uncertain_size,    // its amplitude is below kLeastSigmas sigmas
  open_clock,        // a clock of the inputs that is early or late by a part of a row explains nearly as much
  forgotten_change,  // of a jump: one reading, or a change within the memory of the noise, explains nearly as much
  warm_start,        // of a jump: a machine that was not at rest at the first row explains nearly as much
  switched_input,    // of a jump: an effect of an input that is switched near that moment explains nearly as much
  drift_beside,      // a smaller slow drift without a cause is beside it, so that its form is open
  larger_drift,      // a larger slow drift without a cause is beside it
  in_the_model,      // the model can produce what it adds
  not_shown,         // of an error of the axes: these recordings cannot show it
  not_significant,   // of an error of the axes: beside the others it is not significant
};

// Figures are those of the effect in its most probable set, with the other effects of that set. NaN: not known.
struct Candidate {
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  BoundEffect bound;
  std::string label;  // of the effect, or of its term if it is part of a model
  double p = 0.0;     // probability that it is missing, from the posterior over all sets of effects
  // 2 ln of the likelihood ratio of the readings with and without it; gains, shapes and noise are integrated out. From
  // `threshold` on the evidence is sufficient by itself.
  double likelihood_ratio = 0.0;
  double threshold = kLeastLikelihoodRatio;
  std::vector<FittedParameter> parameters;  // of this effect
  std::vector<Interval> intervals;          // of each parameter
  double amplitude_um = 0.0;                // range (max - min) of its contribution
  double amplitude_sigma_um = kUnknown;     // infinite: not determined
  double rmse_after_um = kUnknown;          // of the model with this effect alone added
  // RMSE in cycles left out of the fit, of the model with the other members of the set and with this one as well; of a
  // series as LedgerRow::held_out_um.
  double held_out_before_um = 0.0, held_out_after_um = 0.0;
  double held_out_evidence = kUnknown;  // gain in ln likelihood of the left-out cycles, without the best cycle
  double p_same_gain = 1.0;             // p-value of equal gains in all cycles
  std::vector<Doubt> doubts;            // none: it may be named
  // An input in any form is more likely in its place than all effects of the catalogue together.
  bool other_form_likelier = false;
  bool in_best_set = false;
  bool minor = false;                         // below max(5 % of the RMSE, the tolerance)
  std::vector<std::string> inseparable_from;  // labels of other effects
};

// ---- The diagnosis.

enum class Verdict {
  named,        // one effect is missing, or one held value is wrong
  probable,     // the same with P >= 0.8
  driver,       // one input drives the missing part; its form is open
  equivalent,   // something is missing; several effects explain it equally well
  unexplained,  // something is missing: a slow drift, a function of time alone, or no effect is likely
  untestable,   // the data could not show a missing effect
  nothing,      // no effect is missing
};
std::string_view name_of(Verdict verdict);

// Why no effect was looked for.
enum class Obstacle {
  none,            // effects were looked for
  still_readings,  // the readings do not change; the verdict is `nothing`
  too_few_values,  // for one more parameter; the verdict is `untestable`
  no_effect,       // of the catalogue can be tested on these data; the verdict is `untestable`
};

struct EffectProbability {
  BoundEffect bound;
  double p = 0.0;
};

// The probability that this column drives the missing part, in whatever form.
struct Driver {
  std::string column;
  double p = 0.0;
  bool is_clear = true;  // false: a slow drift, or a column that was not searched, may be the cause
};

// The probability that a value held in the model is wrong, with the value that fits.
struct OwnValue {
  std::string effect;           // label of the term
  std::string parameter, unit;  // "exponent", "1"
  double held = 0.0, fitted = 0.0;
  Interval interval;  // of the fitted value
  double p = 0.0;
};

// A gain of the model, or of the best set, that differs between runs: the machine has changed.
struct GainByRun {
  std::string effect;               // label
  std::string parameter, unit;      // "gain_um_per_K", "um/K"
  double p = 1.0;                   // p-value of the hypothesis that all runs have the same gain
  std::vector<double> gain, sigma;  // one per run
};

// A column that changes and that no effect of the search could read.
struct ColumnNotSearched {
  std::string column;
  bool has_gaps = false;  // else no effect reads it
  bool is_words = false;  // Series::unread
};

// A column whose resolution is too large to tell it from the cause that was found.
struct CoarseColumn {
  std::string column;
  double resolution = 0.0;  // in the unit of the column
};

// A sensor that stands at the end of its range, or that is stuck; it may be that of the target.
struct Saturated {
  std::string column;
  double share = 0.0;  // of the rows, which are set aside
  bool is_stuck = false;
};

struct Diagnosis {
  std::string target;
  Fit base;
  Verdict verdict = Verdict::nothing;
  Obstacle obstacle = Obstacle::none;
  std::vector<BoundEffect> named, probable;
  std::vector<std::vector<BoundEffect>> equivalent;  // groups; one effect of each is missing; the most probable first
  std::vector<Driver> drivers;                       // with P >= 0.5, the most probable first
  std::vector<OwnValue> own;                         // with P >= 0.05
  std::vector<EffectProbability> effects;            // with P >= 0.01
  std::vector<GainByRun> gains_by_run;               // several runs: the gains that differ
  double p_nothing = 1.0;                            // no effect, no wrong held value, no discrepancy
  double p_discrepancy = 0.0;
  double discrepancy_um = 0.0;        // standard deviation of its posterior mean
  std::string discrepancy_like;       // the effect of time alone that it follows: "settling"; empty: none
  std::string discrepancy_parameter;  // "time constant"
  double discrepancy_time_s = 0.0;    // of that parameter
  std::vector<ColumnNotSearched> columns_not_searched;
  bool has_clock = true;                     // else no lag was searched, and nothing is certain
  std::vector<CoarseColumn> coarse_columns;  // one of them may be the cause: nothing is certain
  std::vector<Saturated> saturated;
  std::vector<SensorJump> sensor_jumps;  // of the data
  std::vector<EqualColumns> equal_columns;
  std::size_t set_aside = 0;          // readings far from all others
  std::size_t level_jumps = 0;        // of the target; three or more are no effect, but a property of the target
  double level_jump_um = 0.0;         // their median
  Noise noise;                        // of the fit with the best set
  std::vector<Candidate> candidates;  // the best set first, then by P; at most 12
  // Range of the sum of the best set, at most that of the readings: effects of the model cancel the rest.
  double explained_um = 0.0;
  // Amplitude up to which an effect could be present and undetected. It is that of the hardest effect to detect among
  // those that are common, at its middle shape, and at most the range of the readings.
  double hidden_um = 0.0;
  BoundEffect hidden;                        // that effect
  double rmse_after_um = 0.0;                // of the fit with the best set
  std::vector<Detectability> detectability;  // as in Preflight
  std::optional<Misfit> where;               // where the model fails most, from the options
};

// nullptr: none of the candidates.
const Candidate* candidate_of(const Diagnosis& diagnosis, const BoundEffect& bound);

struct DiagnosisOptions {
  SearchOptions search;
  double tolerance_um = 0.0;     // smaller effects are called minor
  std::size_t most_rows = 1000;  // largest number of target values used
  bool fit_candidates = true;    // compute Candidate::rmse_after_um
  bool leave_out = true;         // compute Candidate::held_out_before_um and _after_um as the ledger of a model does
  std::optional<Misfit> where;   // worst_place()
};

// Diagnoses one target of the model (an index into model.targets). Throws Error as fit() does.
Diagnosis diagnose(const Model& model, const Series& data, std::size_t target = 0,
                   const DiagnosisOptions& options = {});

}  // namespace ballbar
