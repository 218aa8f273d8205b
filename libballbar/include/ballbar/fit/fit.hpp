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
#include <vector>

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

}  // namespace ballbar
