// Fits a model to a series: parameters with sigma, the contribution of each effect, the residual.
//
// Least squares in Ceres over the rows where the target has a value, weighted by its sigma column (NAME_sigma_UNIT) if
// there is one. One cost function covers the whole series; each effect supplies its block of exact derivatives. The
// noise of the residual is then estimated (noise.hpp), and the fit is repeated with residual and derivatives whitened
// by it (generalised least squares), so that sigma is valid for correlated residuals too. A correlation time longer
// than a tenth of the record indicates misfit rather than noise. The parameters then stay those of ordinary least
// squares, and sigma is widened (sandwich estimator).
//
// Readings of a series far from their neighbours are set aside, such as faults of the logger: at most three in a row,
// more than 10 sigma off the running median of seven (F. R. Hampel 1974, J. Am. Stat. Assoc. 69, 383), with readings of
// one level before and after them. A robust fit discounts them instead.
//
// A robust fit weights the whitened residuals by Tukey's biweight. Values with less than a tenth of full weight are
// discounted: noise, floor, RMSE and number of samples ignore them, and they do not affect the prediction of other
// rows. Shape parameters start from the best points of their grids, the gains solved at every point (variable
// projection); the best three starts are followed. A direction of the parameters that the data do not determine stays
// at its start and is reported in a remark.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/drift/drift.hpp"
#include "ballbar/message.hpp"
#include "ballbar/model/model.hpp"
#include "ballbar/noise/noise.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

enum class ParameterState { free, held, on_lower_bound, on_upper_bound, undetermined };

struct FittedParameter {
  std::string effect;  // label of its term, "constant" for the constant
  std::string name, unit;
  double value = 0.0;
  double sigma = 0.0;  // NaN: held, on a bound, or not known from so few values; infinite: undetermined
  ParameterState state = ParameterState::free;
  ParameterKind kind = ParameterKind::gain;
  ShapeOf shape_of = ShapeOf::curve;
};

struct FitOptions {
  bool robust = false;                        // weight residuals by Tukey's biweight
  bool white = false;                         // ordinary least squares, without a noise model
  std::size_t starts = 3;                     // number of starts of the shape parameters
  std::optional<Noise> noise = std::nullopt;  // known noise of the residual; nullopt: estimate it
  // For circles driven by linear axes and a model that has only errors of the machine: give every error its value from
  // the fit of all machine errors together, and sigma from the noise of that fit, whether or not the model has all of
  // them (machine_errors.hpp).
  bool among_all_errors = false;
};

struct Fit {
  std::string target;
  std::vector<double> time_s;                                  // n rows where the target has a value, but set_aside
  std::vector<std::size_t> row;                                // index of the row in the data, n values
  std::vector<std::size_t> set_aside;                          // rows of a series far from their neighbours, not fitted
  std::vector<double> measured_um, predicted_um, residual_um;  // n each; residual = measured - predicted
  std::vector<double> sigma_um;                                // n stated sigmas of the target; empty: none stated
  std::vector<std::vector<double>> contribution_um;            // n values per term
  std::vector<FittedParameter> parameters;                     // constant first, then term by term
  Eigen::MatrixXd covariance;                                  // of all parameters; 0 for held ones
  Eigen::MatrixXd jacobian;                                    // n by parameters, um per unit, unweighted
  Noise noise;
  Floor floor;
  std::vector<std::size_t> discounted;  // robust fit: rising indices into the n rows
  double n_effective = 0.0;             // effective number of independent samples, without discounted rows
  double rmse_um = 0.0;
  bool converged = false;
  std::vector<Paragraph> remarks;  // whole sentences: more parameters than samples, a parameter on a bound ...
};

// target: index into model.targets. Throws Error where the model does not suit the data (expect_suits), or the target
// has fewer than 3 values.
Fit fit(const Model& model, const Series& data, std::size_t target = 0, const FitOptions& options = {});

// Whether FitOptions::among_all_errors applies: the data are circles of one bar driven by linear axes, and the model
// has only circles and errors of the machine, with all gains free.
bool is_of_machine_errors(const Model& model, const Series& data);

// The model evaluated with the parameters of a fit, on any data that have its columns.
struct Prediction {
  std::vector<double> predicted_um;                  // one value per row of the data
  std::vector<std::vector<double>> contribution_um;  // per term, one value per row
  std::vector<double> sigma_um;  // of predicted_um, from the uncertainty of the parameters; empty: not requested
};
// covariance: that of all parameters (Fit::covariance), to compute sigma_um; nullptr: sigma_um stays empty.
Prediction predict(const Model& model, const std::vector<FittedParameter>& parameters, const Series& data,
                   const Eigen::MatrixXd* covariance = nullptr);

// ---- Where a model fails: the residual grouped by regime, time, signal value and angle, and whether it is white
// noise.
//
// Values that a robust fit discounted are ignored throughout.

// One group of residuals.
struct Misfit {
  std::string what;            // "regime", "time", "T_air_degC", "angle", "quadrant"; with a direction: "angle, CCW"
  std::string from, to;        // as printed, with unit: "0 min", "60 min"; equal for a name or a single value
  std::size_t n = 0;           // number of rows
  double bias_um = 0.0;        // mean residual
  double bias_sigma_um = 0.0;  // sigma of the mean under the noise model, correlation included (exact)
  double rmse_um = 0.0;
  double share = 0.0;  // of the sum of squares of all residuals
};

// Thermal regimes, from the steps of the spindle speed (speed_steps.hpp). Rest is a speed below 2 % of the largest.
//   after_change  first 10 min of every step but the first
//   warming       a higher speed than before, until 60 min after the change
//   cooling       rest, or a lower speed than before, until 2 h after the change
//   standstill    rest after that
//   steady        any other speed after that
// A rest of less than 10 min between two longer stretches of the same speed is a stop for a test and is ignored. A
// record that begins at rest begins with standstill, since the time of the stop is not known; one that begins at a
// speed begins with warming. Returns one regime per row; empty without a known speed.
enum class Regime { standstill, after_change, warming, steady, cooling };
std::vector<Regime> regimes(const std::vector<double>& time_s, const Column& speed);
std::string_view name_of(Regime regime);  // "standstill", "after a change of speed", "warming", "steady", "cooling"

// A run of consecutive rows in one regime.
struct RegimeStretch {
  Regime regime = Regime::standstill;
  double from_s = 0.0, to_s = 0.0;  // time of its first row; of the first row of the next stretch, or the last row
};

// From the first column of role speed; empty without one, or where it has no value.
std::vector<RegimeStretch> regime_stretches(const Series& data);

// Groups by regime (from the first column of role speed), by tenths of the time, and by fifths of every logged signal
// (equal numbers of rows; a signal with at most five different values: by value). Recordings (columns angle_rad,
// direction) are grouped by 30 deg sectors and by quadrants of each direction instead of signals. The groups are in
// this order; groups of fewer than 3 rows are left out.
std::vector<Misfit> where_it_fails(const Fit& fit, const Series& data);

// Tests whether the whitened residual is white: Kolmogorov-Smirnov distance of the cumulated periodogram, with its
// p-value (Stephens 1970). The residual is whitened by the noise of the fit and treated as an evenly spaced sequence.
// If its length has a prime factor above 100, the last few rows are left out. p = 1 for fewer than 16 rows, and for a
// zero residual (all below 1e-9 um).
// Source: J. Durbin, Tests for serial correlation in regression analysis based on the periodogram of least-squares
// residuals, Biometrika 56 (1969) 1.
struct Whiteness {
  std::vector<double> autocorrelation;  // of the unwhitened residual about 0, lags 1 to 10
  double periodogram_distance = 0.0;
  double p = 1.0;
};
Whiteness whiteness(const Fit& fit);

// True if the RMSE is at most 1.2 times the floor and the residual is white (p >= 0.01).
bool is_adequate(const Fit& fit, const Whiteness& whiteness);

// The group whose share of the sum of squares exceeds its share of the rows most, if by more than a tenth.
std::optional<Misfit> worst_place(const Fit& fit, const std::vector<Misfit>& where);

// What the residual is. It is not noise if p < 0.01; it is slow if a tenth of its variance is correlated.
enum class ResidualKind { too_few, not_noise, slow_not_noise, slow, noise };
struct ResidualNature {
  ResidualKind kind = ResidualKind::noise;
  double correlation_time_s = 0.0;  // of a slow one
};
ResidualNature residual_nature(const Fit& fit, const Whiteness& whiteness);

// ---- The coefficient of an effect in the units of its user: um for each kelvin of one column, and what it comes to.

struct Coefficient {
  std::string effect;    // label of its term
  std::string column;    // of the data
  std::string unit;      // "um/K"
  Estimate value;        // sigma NaN: held, or not known
  double span_K = 0.0;   // largest less smallest value of the column in the fitted rows
  double size_um = 0.0;  // largest less smallest value of the effect there
  // While the effect rises and while it falls, fitted apart with all other parameters at once, under the noise of the
  // fit. A change of direction is a turn by more than a fifth of its span. nullopt: one direction has less than a
  // fifth.
  std::optional<Estimate> rising, falling;
  double usual_low = 0.0, usual_high = 0.0;  // of |value|; both 0: not stated
  std::string usual;                         // where that range comes from
};

// Of each effect with one input and one gain in um/K. `fit` is that of the model on the data.
std::vector<Coefficient> coefficients_of(const Model& model, const Fit& fit, const Series& data);

bool is_usual(const Coefficient& coefficient);

}  // namespace ballbar
