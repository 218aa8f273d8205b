// How well batches are predicted that were left out, in one number for every kind of model, and for none.
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
  std::size_t worst = 0;  // its batch
};

// Of the RMSE of each batch; at least one.
HeldOutErrors held_out_errors(std::span<const double> batch_rmse_um);

// Of a model of effects, its first target: fitted to all batches but one (joined_batches), and that one predicted.
// before_fit is told which is left out. At least 2 batches; throws Error as joined_batches and fit.
HeldOutErrors held_out_errors(const Model& model, std::span<const Series> batches, const FitOptions& options,
                              const std::function<void(std::size_t batch)>& before_fit = {});

// What a model has to gain: the same rms where 0 um is predicted.
double rms_without_model_um(std::span<const Batch> batches);

// Batches one after the other as one series, so that a model of effects can be fitted to all of them at once. Each
// begins where effects begin: its temperatures are rises on those of its first row, 10 days after the batch before, in
// which the machine stands still, as warm as at the start. In these days nothing is measured (gaps of the target). What
// a machine remembers from before a batch is not known and taken as nothing. Only the columns of the model are kept. At
// least one batch; throws Error where a batch lacks a column.
Series joined_batches(std::span<const Series> batches, const Model& model);

}  // namespace ballbar
