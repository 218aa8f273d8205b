// What a regression predicts for a series, where that leaves what was trained, and what is left of the measured.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ballbar/model/live_model.hpp"
#include "ballbar/model/model.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

// A column, its rise, or a component of the temperatures that leaves its trained range.
struct OutsideRange {
  std::string what;                           // "T_front_degC", "T_front_degC rise", "component 2"
  double value = 0.0, low = 0.0, high = 0.0;  // the farthest; in training
  double time_s = 0.0;                        // first time outside
  std::size_t rows = 0;
};

// By a tenth of its span at either end: what is still taken for inside.
ColumnRange with_margin(const ColumnRange& range);

// Nothing where no row is beyond with_margin. NaN is not.
std::optional<OutsideRange> outside_of(const ColumnRange& range, std::span<const double> values,
                                       std::span<const double> time_s);

// How much of what is predicted goes with a column: shares of the range of the prediction, which add up to it; the
// share of x is range cov(x, y) / var(y). A term with several columns counts for its first.
struct DriverShare {
  std::string column;
  Role role = Role::structure;
  double share_um = 0.0;
};

// Where a prediction by effects stands, so that later rows go on from there.
struct PredictionState {
  LiveModel::State live;
  bool since_end = false;  // it went on from the end of training
};

struct RegressionPrediction {
  std::vector<double> predicted_um;   // n; NaN where a column has no value
  std::vector<double> half_width_um;  // of a 95 % interval
  std::vector<OutsideRange> outside;

  // By temperatures. The half width grows with T2 as the mean of a regression does, and where Q is beyond training by
  // all that the model makes of the rest.
  std::vector<double> T2_of_largest, Q_of_largest;  // each over the largest in training: above 1 is outside
  // Sensors of which one looks broken: with the reading that the others suggest for it nearly every odd row is
  // ordinary. More than one where the others do not tell which.
  std::vector<std::string> broken;

  // By effects. The half width is that of gains, discrepancy and noise.
  Eigen::MatrixXd drivers_um;        // n by drivers, what each adds
  std::vector<DriverShare> drivers;  // the largest first
  bool goes_on = false;              // the series goes on from the end of training, or from an earlier prediction
  bool holds = false;                // it holds the training rows: it goes on in itself
  PredictionState end;               // after the last row
};

// Measured less predicted.
struct PredictionError {
  std::size_t rows = 0;
  double mean_um = 0.0;  // of the absolute error
  double rmse_um = 0.0;
  double within_share = 0.0;  // within the 95 % interval: 0 to 1
};

// measured_um: one a row of the prediction, NaN where it was not; of rows from `first` on. Nothing where no row was.
std::optional<PredictionError> error_of(const RegressionPrediction& prediction, std::span<const double> measured_um,
                                        std::size_t first = 0);

// Rows where a regression on temperatures extrapolates.
struct Extrapolation {
  std::size_t far = 0;   // farther out than any in training (Hotelling T2)
  std::size_t odd = 0;   // unlike all in training (Q)
  bool matters = false;  // of either more than 2 rows and than 2 %: the limits are single rows, a few pass by chance
};
Extrapolation extrapolation_of(const RegressionPrediction& prediction);

}  // namespace ballbar
