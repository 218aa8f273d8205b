// Errors of predictions of left-out batches, comparable for all kinds of models, and for no model.
#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include "ballbar/fit/fit.hpp"
#include "ballbar/predict/batch.hpp"

namespace ballbar {

struct HeldOutErrors {
  double rms_um = 0.0;    // root of the mean square over batches of each one's RMSE
  double worst_um = 0.0;  // the largest RMSE
  std::size_t worst = 0;  // index of that batch
};

// From the RMSE of each batch; at least one.
HeldOutErrors held_out_errors(std::span<const double> batch_rmse_um);

// For the first target of a model of effects: fits all batches but one (joined_batches) and predicts that one, for each
// in turn. Calls before_fit with the left-out batch. At least 2 batches. Throws Error as joined_batches() and fit() do.
HeldOutErrors held_out_errors(const Model& model, std::span<const Series> batches, const FitOptions& options,
                              const std::function<void(std::size_t batch)>& before_fit = {});

// The same rms for a prediction of 0 um, as a baseline.
double rms_without_model_um(std::span<const Batch> batches);

// Joins batches into one series, so that a model of effects can be fitted to all of them together. The temperatures of
// each batch are rises since its first row. Between two batches are 10 days in which the machine rests at its start
// temperature without measurements (gaps of the target). The thermal history before a batch is unknown and assumed to
// be none. Only the columns of the model are kept. At least one batch; throws Error if a batch lacks a column.
Series joined_batches(std::span<const Series> batches, const Model& model);

}  // namespace ballbar
