// A prediction by a regression over batches, held against what was measured and against what was trained on.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "ballbar/batches/batch_regression.hpp"

namespace ballbar {

struct PredictionError {
  double rmse_um = 0.0;       // of measured less predicted
  double within_share = 0.0;  // of the measured rows, within the 95 % interval: 0 to 1
};

// measured_um: one a row of the prediction, NaN where it was not; nothing where no row was.
std::optional<PredictionError> error_of(const BatchPrediction& prediction, std::span<const double> measured_um);

// Rows where the model extrapolates.
struct Extrapolation {
  std::size_t far = 0;   // farther out than any in training (Hotelling T2)
  std::size_t odd = 0;   // unlike all in training (Q)
  bool matters = false;  // of either more than 2 rows and than 2 %: the limits are single rows, a few pass by chance
};
Extrapolation extrapolation_of(const BatchPrediction& prediction);

}  // namespace ballbar
