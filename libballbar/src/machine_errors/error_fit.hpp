// The linear least squares fit of a machine's errors: gains, their covariance, and the residual.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "ballbar/machine_errors/machine_errors.hpp"
#include "ballbar/units.hpp"
#include "machine_errors/error_model.hpp"
#include "machine_errors/error_noise.hpp"

namespace ballbar {

// One effect of the fit: its columns and its significance.
struct FittedEffect {
  const Effect* effect = nullptr;
  std::optional<double> shape;
  std::vector<std::size_t> columns;  // indices into JointErrorFit::columns
  double searched = 1.0;             // number of independent shapes tried
  double looked_at = 1.0;            // number of errors of its kind: the four spikes, or all others
  bool in_the_fit = true;            // false: fitted separately, for inspection
  bool is_needed = true;             // false: a spike, and a step of another width explains it
  double p_damped = 0.0;             // p-value with the usual prior; 0: no prior
};

// Effects that are significant together and not each by itself.
struct FittedGroup {
  std::vector<std::size_t> effects;         // indices into JointErrorFit::effects
  std::vector<Eigen::VectorXd> alone;       // the gains of each, if it is the only one
  std::vector<Eigen::MatrixXd> covariance;  // of these
  double p = 1.0;
};

struct JointErrorFit {
  ErrorRows rows;  // deviation_um freed of what a centre adds in second order
  ErrorColumns columns;
  Eigen::MatrixXd at_once;        // the first fine columns, with play that is taken up at once
  Eigen::VectorXd gains;          // one a column
  Eigen::VectorXd as_instrument;  // likewise, by the estimator of as_instrument.hpp; NaN: it has none
  Eigen::MatrixXd covariance;     // of the gains
  Eigen::VectorXd curve_gains;    // gains for curves and residuals; regularised on an arc
  Eigen::MatrixXd map, weighted;  // curve gains = map weighted' deviation of the rows
  Eigen::MatrixXd normal;         // X' X of the columns together and the extra ones
  std::vector<FittedEffect> effects;
  std::vector<FittedGroup> groups;
  std::vector<WeightedNoise> noise;
  std::vector<PriorStatement> prior;  // of the instrument's estimator
  std::vector<std::string> undetermined;
  Eigen::VectorXd second_order_um;  // of the fine rows, taken off
  double slow_variance_um2 = 0.0;
  double arc_rad = 0.0;
  std::vector<double> freed_um;  // readings without the fitted centre
  double within_um2 = 0.0;       // mean square of readings about the mean of their row

  // Fine rows of the curve of one effect; nullptr: the circles.
  Eigen::VectorXd fine_curve(const Effect* effect) const;
  // Whether each column is in the fit.
  std::vector<bool> in_the_fit() const;
  // Per row: deviation minus the fit.
  Eigen::VectorXd residual() const;
  // RMS of the readings for this residual of the rows.
  double rms_um(const Eigen::VectorXd& left) const;
};

// p-value of these gains: all together (chi^2), or the most significant one.
double p_of(const Eigen::VectorXd& values, const Eigen::MatrixXd& covariance);

// Significance level for one effect among `looked_at`: 1 % that any of a kind is found in noise.
inline constexpr double kFalseErrors = 0.01;

// Properties of a test as a whole.
struct ErrorSetUp {
  double arc_rad = 0.0;     // that the longest recording covers
  double middle_rad = 0.0;  // mean direction of all readings
  double length_mm = 0.0, height_mm = 0.0;
  std::optional<double> pitch_a_mm, pitch_b_mm;
};

JointErrorFit joint_error_fit(ErrorRows rows, const MachineErrorOptions& options, const ErrorSetUp& set_up);

// Of trace_of() recordings of one plane, one bar and linear axes.
JointErrorFit joint_error_fit(const Series& trace, const MachineErrorOptions& options);

// The trace with a feed for each reading. If no recording states one, delays are in um: travel in that time. Otherwise
// a recording without a feed tells nothing of what grows with it.
Series with_feed(Series trace);

// Arc that the longest recording of a trace covers.
double longest_arc_rad(const Series& trace);
inline constexpr double kShortestArc_rad = 60.0 * kPi / 180.0;  // shorter arcs cannot separate the errors

// Whether the column is of the centre, common or of one recording; not the difference between CCW and CW.
bool is_centre(const ErrorColumn& column);

}  // namespace ballbar
