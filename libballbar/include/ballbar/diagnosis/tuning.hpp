// Every number of the diagnosis that is a choice.
//
// A study changes them to measure what each buys (tests/study/ablation); nothing else sets them. `off` is the value
// that switches a device off. d: root of the fall of chi^2. ln: natural logarithm of a likelihood. P, shares: 0 to 1.
#pragma once

#include <cstddef>

namespace ballbar {

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
  bool rows_at_jumps = true;         // rows within the sample of a step tell nothing
  // Saturated sensors: the rows at the end of a sensor's range are set aside.
  std::size_t fewest_at_end = 10;     // rows of a run
  double least_at_end = 0.05;         // share of all rows; off: 1
  double small_step = 1.5;            // resolutions: a sensor that comes to rest takes such steps before
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
  double shortest_lag = 2.0;  // samples; a shorter lag is the sampling of the logger; off: 0

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
  int most_refined = 3;           // times
  double same_shape = 0.01;       // relative
  double same_model = 0.02;       // of a shape's prior sigma
  double better = 0.05;           // ln: smallest improvement
  double better_fit = 1e-3;       // of the square
  double usual_time_s = 1500.0;   // second start of a model whose fit has diverged; off: infinity
  bool whole_about_jumps = true;  // of a thinned series all values about a jump

  // Averages (posterior/posterior, sets).
  double far_from_best = 7.0;  // ln: kinds of discrepancy this far are left out
  double least_of_set = 1e-3;  // smallest P of a listed set
  std::size_t most_sets = 200;

  // Tests of a member, and the verdict (verdict).
  double same_gain = 0.01;           // p: gains of the cycles differ if it is smaller; off: 0
  double held_out_evidence = 3.0;    // ln of the likelihood of left-out cycles, without the best one; off: -infinity
  double moves = 0.05;               // share of the square of a cycle, of the largest: an effect stands still with less
  double credible = 0.95;            // P of a credible set, of that of its single effect
  double rest = 3.0;                 // stated sigmas of the readings: a larger remaining error is unexplained
  double follows = 0.9;              // R^2 from which a drift is said to be like an effect of time
  bool beside_discrepancy = true;    // beside a larger drift no cause is named
  bool jump_that_stays = true;       // a jump explains more than a change that the noise forgets
  bool columns_not_searched = true;  // beside a column that was not searched nothing is certain
};

}  // namespace ballbar
