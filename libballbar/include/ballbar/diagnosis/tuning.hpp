// The devices of the diagnosis, each of which can be switched off to measure what it buys (tests/study/ablation).
#pragma once

namespace ballbar {

struct Tuning {
  // The data.
  bool steps_within_samples = true;
  bool smoothing = true;
  bool rows_at_jumps = true;
  bool saturated_rows = true;
  bool jumps_of_temperature = true;
  bool whole_about_jumps = true;
  // The model of the data.
  bool discrepancy = true;
  bool bounded_memory = true;
  bool cost_of_hyperparameters = true;
  bool input_times = true;
  bool held_values = true;
  bool any_forms = true;
  bool any_forms_first = true;
  bool prior_of_lags = true;
  bool lags_above_sampling = true;
  bool prior_of_pairs = true;
  // Outliers.
  bool student_t = true;
  bool level_jumps = true;
  // The search.
  bool finer_shapes = true;
  bool finer_rivals = true;
  bool refine = true;
  // Tests of members and drivers.
  bool same_gain = true;
  bool held_out = true;
  bool beside_discrepancy = true;
  bool columns_not_searched = true;
};

}  // namespace ballbar
