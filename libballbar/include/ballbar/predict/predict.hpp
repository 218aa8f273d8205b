// What a trained regression predicts for a series: values with a 95 % interval, the rows outside the trained range, the
// share of each driver, and the error where the target was measured as well.
//
// The regressions themselves are in train.hpp: on all effects of the catalogue (one machine, rows in time), or on
// temperatures over batches of tests. Both return the same RegressionPrediction; the members of the other kind stay
// empty.
//
//   predicted_um +- half_width_um     holds 95 % of later rows, if these are like those of training
//
// Outside the trained range by more than a tenth of its span the interval is too narrow by an unknown amount: the rows
// are listed in `outside`, not widened. The interval of a regression on effects has the uncertainty of gains,
// discrepancy and noise; that of a regression on temperatures the errors of left-out batches.
//
// Accuracy: 92.7 to 96.0 % of the values of left-out thirds of simulated records lie within the interval. Spindles
// whose physics is no effect of the catalogue: tests/study, predictions.
//
// Signs: a prediction is in the frame of the target; PredictionError is measured minus predicted. Errors: none of the
// functions of this header throws; NaN is a row without a value.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ballbar/model/model.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

// A column, its rise, or a component of the temperatures outside its trained range.
struct OutsideRange {
  std::string what;                           // "T_front_degC", "T_front_degC rise", "component 2"
  double value = 0.0, low = 0.0, high = 0.0;  // the most extreme value; range in training
  double time_s = 0.0;                        // first time outside
  std::size_t rows = 0;
};

// The range widened by a tenth of its span at either end. Values within count as inside.
ColumnRange with_margin(const ColumnRange& range);

// Returns nullopt if no row is outside with_margin(). NaN does not count as outside.
std::optional<OutsideRange> outside_of(const ColumnRange& range, std::span<const double> values,
                                       std::span<const double> time_s);

// The share of a column in the prediction. Shares add up to the range of the prediction; the share of x is range
// cov(x, y) / var(y). A term with several columns counts for its first column.
struct DriverShare {
  std::string column;
  Role role = Role::structure;
  double share_um = 0.0;
};

// The state of a prediction by effects, so that later rows can continue it.
struct PredictionState {
  LiveModel::State live;
  bool since_end = false;  // it continued from the end of training
};

struct RegressionPrediction {
  std::vector<double> predicted_um;   // n; NaN where a column has no value
  std::vector<double> half_width_um;  // of a 95 % interval
  std::vector<OutsideRange> outside;

  // Regression on temperatures. The half width grows with T2 like the variance of the regression, and if Q exceeds
  // training by the full contribution of the unexplained part of the inputs.
  std::vector<double> T2_of_largest, Q_of_largest;  // divided by the largest in training; above 1 is outside
  // Sensors of which one seems broken: replacing its reading by the value expected from the others makes nearly all odd
  // rows ordinary. Several sensors if the others do not show which one it is.
  std::vector<std::string> broken;

  // Regression on effects. The half width comes from gains, discrepancy and noise.
  Eigen::MatrixXd drivers_um;        // n by drivers: contribution of each
  std::vector<DriverShare> drivers;  // the largest first
  bool goes_on = false;              // the series continues training or an earlier prediction
  bool holds = false;                // the series contains the training rows
  PredictionState end;               // after the last row
};

// The error of a prediction: measured minus predicted.
struct PredictionError {
  std::size_t rows = 0;
  double mean_um = 0.0;  // of the absolute error
  double rmse_um = 0.0;
  double within_share = 0.0;  // within the 95 % interval: 0 to 1
};

// measured_um: one value per row of the prediction, NaN: not measured. Uses the rows from `first` on. Returns nullopt
// if none of them was measured.
std::optional<PredictionError> error_of(const RegressionPrediction& prediction, std::span<const double> measured_um,
                                        std::size_t first = 0);

// Numbers of rows in which a regression on temperatures extrapolates.
struct Extrapolation {
  std::size_t far = 0;   // rows farther out than any in training (Hotelling T2)
  std::size_t odd = 0;   // rows unlike all in training (Q)
  bool matters = false;  // one of them exceeds 2 rows and 2 %; a few rows pass the limits by chance
};
Extrapolation extrapolation_of(const RegressionPrediction& prediction);

}  // namespace ballbar
