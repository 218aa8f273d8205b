// What a search for missing effects looks for, with which numbers, and what the data could show at all.
//
//   SearchOptions   effects, motion, effects left out, the tuning, progress
//   Tuning          every number of the diagnosis that is a choice
//   preflight()     before any residual is examined: which effects these data could show, and from which size on
//   k...            the limits of verdicts, which callers print
//
// d: root of the expected fall of chi^2. ln: natural logarithm of a likelihood. P, shares: 0 to 1.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/circle/recording.hpp"
#include "ballbar/effects/effect.hpp"
#include "ballbar/fit/fit.hpp"
#include "ballbar/model/model.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

// ---- Limits.

// Detectability of an effect before any residual is examined.
inline constexpr double kDetectable = 5.0;    // d
inline constexpr double kIdentifiable = 7.5;  // d

// Tests of a member of a set.
inline constexpr double kLeastLikelihoodRatio = 10.0;  // 2 ln of a likelihood ratio; 10 is about 150 to 1
inline constexpr double kLeastSigmas = 5.0;            // of an amplitude beside free shapes of all effects

// Verdict.
inline constexpr double kNamed = 0.9;        // P
inline constexpr double kProbable = 0.8;     // P
inline constexpr double kNothing = 0.5;      // P of nothing from which the verdict is `nothing`
inline constexpr double kSureDriver = 0.9;   // P
inline constexpr double kDiscrepancy = 0.5;  // P of a slow drift without a cause from which it is reported

// Effects of a model.
inline constexpr double kDropTest = 0.05;  // an effect is needed if P that it is not is smaller

// The next test.
inline constexpr double kSureEnough = 0.95;    // P(right) of a test from which no longer test is considered
inline constexpr double kSureOfNothing = 0.8;  // P of nothing from which no test is planned

// ---- Every number of the diagnosis that is a choice.
//
// A study changes them to measure what each buys (tests/study/ablation); nothing else sets them. `off` is the value
// that switches a device off. d: root of the fall of chi^2. ln: natural logarithm of a likelihood. P, shares: 0 to 1.

struct Tuning {
  // Inputs as they were logged (evidence/logged_inputs). They decide what the samples of a column were.
  double jump = 0.03;                // share of a column's range, from row to row: a step of the input
  double longest_ramp_s = 90.0;      // a longer change is no step
  double longest_sample_s = 120.0;   // of a logger; rows farther apart are read one by one
  std::size_t longest_held = 12;     // rows between samples that a logger joins by straight lines
  double bends = 0.9;                // share of the square of a column's bends that lies at such samples
  double climbs = 0.8;               // share of the runs of a coarse column that differ by one resolution
  std::size_t levels_of_switch = 6;  // a temperature with more is not switched
  std::size_t fewest_changes = 8;    // of a column, to determine its sampling interval
  bool steps_within_samples = true;  // a step is drawn in the middle of its sample
  bool smoothing = true;             // of temperatures
  bool outliers_of_inputs = true;    // readings far from the smooth curve count less
  bool equal_columns = true;         // those that measure the same quantity get the mean of their curves
  bool rows_at_jumps = true;         // rows within the sample of a step tell nothing
  // Saturated sensors: the rows at the end of a sensor's range are set aside.
  std::size_t fewest_at_end = 10;     // rows of a run
  double least_at_end = 0.05;         // share of all rows; off: 1
  double small_step = 1.5;            // resolutions: a sensor that comes to rest takes such steps before
  bool stuck_sensors = true;          // stuck sensors, too
  double most_saturated = 2.0 / 3.0;  // share of the rows; with more, none is set aside
  // A jump of the target within `rows_about_jump` rows of one of a temperature is that of the temperature.
  double temperature_jump = 0.2;         // share of its range, from row to row; off: 1
  double most_temperature_jumps = 0.02;  // share of the rows; a temperature with more, and more than 5, is noise
  std::size_t rows_about_jump = 2;

  // Delays of the inputs of the model (evidence/base_model): open columns.
  double clock_delay = 0.6;      // sd of the delay of a clock, in samples; off: 0
  double jump_delay = 0.35;      // sd of the time of a step within its sample, in samples; off: 0
  std::size_t most_delays = 40;  // columns
  std::size_t rows_for_a_delay = 10;

  // Priors of the identities of a single effect (posterior/problem, identities).
  double none = 0.8;          // P that it is nothing
  double held_values = 0.4;   // P of all held values together; off: 0
  double pairs = 0.1;         // P of all effects of two columns together
  double forms = 0.05;        // P of inputs in any form together; off: 0
  double at_once = 0.5;       // P of the shapes of an effect that have no lag, of those of one that may have; off: 0
  double shortest_lag = 2.0;  // samples of its logger; a shorter lag is the sampling; off: 0

  // Covariance of the readings (posterior/hyperparameters). The longest memory of the noise is SearchOptions'.
  double discrepancy = 0.2;                  // P of a slow drift without a cause; off: 0
  double hyperparameter = 2.0;               // ln, cost of each; off: 0
  std::size_t fewest_for_memory = 30;        // rows; with fewer the noise is white
  double shortest_discrepancy = 1.25;        // of the longest memory of the noise
  double most_new = 3.0;                     // of a rough discrepancy from row to row, over the noise
  double most_white = 5.0;                   // ln of white over what is new of the memory in a step
  double first_step = 1.0, last_step = 0.2;  // ln, of the compass search

  // Readings far from the others, and jumps of the target (posterior/robust).
  double freedom = 4.0;           // degrees of Student's t
  double outlier = 2.0;           // factor on the variance from which a reading counts less; off: infinity
  std::size_t fewest_levels = 3;  // jumps of the residual that are a process of the target; off: many
  double jump_off = 5.0;          // usual changes
  double sharp = 0.5;             // share of a jump from one row to the next
  std::size_t rows_of_level = 3;  // on either side of a jump
  std::size_t rows_of_trend = 9;  // likewise, of the trend: a jump shows in fewer than half of them
  std::size_t most_levels = 80;

  // Iterative Bayesian stepwise selection (posterior/ibss).
  double rises = 0.01;          // smallest rise of the lower bound, ln
  double same_scatter = 0.005;  // change of ln of the variance
  double settled = 0.1;         // likewise; beyond it the columns are projected again
  int most_sweeps = 40;
  double hardly_there = 0.2;  // P of a further single effect, from which all are fitted again
  std::size_t most_effects = 8;

  // Search for the model and the shapes (posterior/search, conditional_fit).
  bool any_forms_first = true;    // the first covariances are found beside inputs in any form
  bool finer_shapes = true;       // between the points of the grid
  std::size_t sharpened = 4;      // the strongest effects of a single effect that get finer shapes; off: 1
  double far_rival = 7.0;         // ln: a rival so much weaker gets none
  double of_grid = 0.1;           // more, of the evidence gained: a coarse grid may cost so much
  bool refine = true;             // each effect of the sum is left out once
  double far_mode = 30.0;         // ln: a mode so far below at first is not followed; off: infinity
  int most_refined = 3;           // times
  double same_shape = 0.01;       // relative
  double better = 0.05;           // ln: smallest improvement
  double better_fit = 1e-3;       // of the square
  double usual_time_s = 1500.0;   // second start of a model whose fit has diverged; off: infinity
  bool whole_about_jumps = true;  // of a thinned series all values about a jump

  // Averages (posterior/posterior, sets).
  double far_from_best = 7.0;  // ln: kinds of discrepancy and modes this far are left out
  bool modes = true;           // other modes than the likeliest
  double least_of_set = 1e-3;  // smallest P of a listed set
  std::size_t most_sets = 200;

  // Tests of a member, and the verdict (verdict).
  double same_gain = 0.01;           // p: gains of the cycles differ if it is smaller; off: 0
  double held_out_evidence = 3.0;    // ln of the likelihood of left-out cycles, without the best one; off: -infinity
  double moves = 0.05;               // share of the square of a cycle, of the largest: an effect stands still with less
  double credible = 0.95;            // P of a credible set, of that of its single effect
  double rest = 3.0;                 // stated sigmas of the readings: a larger remaining error is unexplained
  double follows = 0.9;              // R^2 from which a drift is described by an effect of time
  bool beside_discrepancy = true;    // beside a larger drift no cause is named
  bool jump_that_stays = true;       // a jump explains more than a change that the noise forgets
  bool columns_not_searched = true;  // beside a column that was not searched nothing is certain
  bool coarse_columns = true;        // nor beside one whose resolution hides whether it is the cause
};

// Columns that measure the same quantity: equal up to a factor near 1, a constant and noise. No data tell them apart.
// `column` stands for all that are equal to it.
struct EqualColumns {
  std::string column, other;
  bool operator==(const EqualColumns&) const = default;
};

// ---- Options of a search for missing effects.

// The probability that an effect is missing.
struct ProbableSoFar {
  BoundEffect bound;
  double p = 0.0;
};

struct SearchOptions {
  Catalogue catalogue = built_in_catalogue();  // effects to search; a diagnosis points to them
  std::optional<Motion> motion;                // what moved the ballbar, for recordings
  std::vector<std::string> without;            // names of effects to leave out of the search
  // Of the noise, on a drift. What changes more slowly has a cause, known or not.
  double longest_memory_s = 1200.0;
  Tuning tuning;
  // Called before each step, in the calling thread: "testing 2 effects".
  std::function<void(std::string_view step)> progress;
  // Called with all effects, the most probable first, in the calling thread: after the first ascent with the
  // probabilities of its mode, at last with those of the posterior.
  std::function<void(const std::vector<ProbableSoFar>& effects)> so_far;
};

// ---- Which effects the data could show at all, judged before any residual is examined.
//
// For every effect of a catalogue and every column it could read, take its signature g: the curve of a unit gain, at
// each point of its shape grid. W whitens it by the noise. P removes the part that the model can already produce, the
// columns of W J. The remaining part P W g decides:
//
//   surviving share   |P W g|^2 / |W g|^2;           below 0.05 the model absorbs the effect
//   d                 gain |P W g|                    root of the expected fall of chi^2
//   detectable        range (max - min) in um of an effect with d = 5; identifiable: range with d = 7.5
//   coherence         |cos| between the remaining signatures of two effects. Two effects are inseparable in these data
//                     if it exceeds 0.95 at most shapes of one of them, with the best shape of the other.
//
// For an effect with several gains the coherence is the smallest canonical correlation of the spaces that they span,
// and d is that of the first gain. Of more than 1500 values of the target only every second, third ... is used.

enum class Testability {
  testable,
  input_missing,
  input_constant,
  absorbed,
  in_the_model,
  other_motion,
  no_clock,
  rows_too_far_apart,  // too far apart to resolve the period of a periodic effect
};

// An input for which the data have no column.
struct MissingInput {
  std::string role;
  std::vector<std::string> units;  // accepted; empty: any

  friend bool operator==(const MissingInput&, const MissingInput&) = default;
};

// What the data lack to show an effect. The facts of each testability are in its members; the others keep their default
// values.
struct Deficiency {
  // input_missing. Empty: columns of the units are there, but none is accepted, or they are too few.
  std::vector<MissingInput> missing_inputs = {};
  std::string none_accepted = {};     // input_missing: Input::none_accepted of the effect; empty: it has none
  bool has_gaps = false;              // input_constant: the input has gaps; else it does not change
  std::optional<Motion> motion = {};  // other_motion: of the recordings
  double step_s = 0.0;                // rows_too_far_apart: of the rows
  double period_s = 0.0;              // rows_too_far_apart: of the effect

  friend bool operator==(const Deficiency&, const Deficiency&) = default;
};

// How well one effect imitates another: the median over the other's shapes of the coherence with the most similar shape
// of this effect.
struct Likeness {
  std::string with;
  double coherence = 0.0;
};

struct Detectability {
  const Effect* effect = nullptr;
  std::vector<std::string> columns;  // of the best binding; empty: no binding
  std::size_t bindings = 0;          // number of column choices that the data offer
  std::size_t searched = 0;          // number of these that were searched
  Testability testability = Testability::testable;
  Deficiency deficiency;  // why it is not testable
  double surviving_share = 0.0;
  double detectable_um = 0.0;
  double identifiable_um = 0.0;
  std::vector<std::string> inseparable_from;  // names of effects that are not in the model
  std::vector<Likeness> imitated_by;          // every other testable effect
};

enum class NoiseSource {
  residual,  // of the model
  target,    // about its mean, of a model without terms: every real effect counts as noise
};

struct Preflight {
  std::string target;
  std::size_t n = 0;
  Noise noise;
  NoiseSource noise_source = NoiseSource::residual;
  std::vector<Detectability> detectability;  // in the order of the catalogue
};

// Uses the noise and the Jacobian of the model's fit. A model without terms is a constant; every real effect then
// counts as noise, which is pessimistic. Throws Error as fit() does. motion: what moved the ballbar in the recordings;
// effects of other motions do not apply.
Preflight preflight(const Model& model, const Series& data, std::size_t target = 0,
                    std::optional<Motion> motion = std::nullopt, const Catalogue& catalogue = built_in_catalogue());

}  // namespace ballbar
