// The fit of a machine's errors to the recordings of a test: gains, their covariance, and the residual.
//
//   1  circles and errors of all readings;          4  noise, widths of the steps of play, spikes
//   2  cyclic errors, of the pitch that is stated,  5  all gains; in the fit are the errors of 3 and 4 that are
//      or that lowers the rest of 1 most               significant
//   3  errors where they show, likewise             6  where a spike is, 4 and 5 without the readings under it
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "ballbar/machine_errors/machine_errors.hpp"
#include "machine_errors/error_design.hpp"
#include "machine_errors/error_groups.hpp"
#include "machine_errors/error_noise.hpp"

namespace ballbar {

struct JointErrorFit {
  ErrorRows rows;  // deviation_um freed of what a centre adds in second order
  ErrorDesign design;
  Eigen::MatrixXd at_once;        // fine rows of the errors of all readings, with play that is taken up at once
  Eigen::VectorXd gains;          // one a column; of an error that is not in the fit from the fit of all
  Eigen::MatrixXd covariance;     // of the gains
  Eigen::VectorXd as_instrument;  // by the estimator of as_instrument.hpp; NaN: it has none
  Eigen::VectorXd curve_gains;    // gains for curves and residuals; with the usual prior on an arc
  Eigen::MatrixXd map;            // curve gains = map design.z' deviation of the rows
  std::vector<FittedGroup> groups;
  std::vector<WeightedNoise> noise;
  std::vector<PriorStatement> prior;  // of the instrument's estimator
  std::vector<std::string> undetermined;
  Eigen::VectorXd second_order_um;  // of the fine rows, taken off
  double slow_variance_um2 = 0.0;
  bool is_full = false;          // full turns
  Indices centres;               // columns of the centre, of all and of single recordings
  bool centre_of_fit = true;     // false: of the circles alone, on an arc of less than half a turn
  Eigen::MatrixXd centre_map;    // gains of the centres = centre_map deviation of the rows
  std::vector<double> freed_um;  // readings without the centre
  double within_um2 = 0.0;       // mean square of readings about the mean of their row

  const std::vector<ErrorColumn>& columns() const { return design.x.columns; }
  // Fine rows of the centre that fits fine rows.
  Eigen::VectorXd centre_curve(const Eigen::VectorXd& fine) const;
  // Fine rows of the curve of one effect.
  Eigen::VectorXd fine_curve(const Effect* effect) const;
  // Whether each column is in the fit.
  std::vector<bool> in_the_fit() const;
  // Per row: deviation minus the fit.
  Eigen::VectorXd residual() const;
  // RMS of the readings for this residual of the rows.
  double rms_um(const Eigen::VectorXd& left) const;
};

// Of trace_of() recordings of one plane, one bar and linear axes.
JointErrorFit joint_error_fit(const Series& trace, const MachineErrorOptions& options);

}  // namespace ballbar
