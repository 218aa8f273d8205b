// A model fitted to a series: parameters with sigma, what each effect contributes, what is left.
//
// Least squares in Ceres over the rows where the target has a value, weighted by its sigma column (NAME_sigma_UNIT)
// where there is one; one cost for the whole series with each effect's block of exact derivatives. The noise of the
// residual is then estimated (noise.hpp) and the fit repeated with residual and derivatives whitened by it
// (generalised least squares), so that sigma holds for residuals with a memory. A memory longer than a tenth of the
// record is misfit rather than noise: then the parameters stay those of least squares and sigma is widened for it
// (sandwich). A robust fit weighs the (whitened) residuals by Tukey's biweight; values of less than a tenth of full
// weight are discounted: they count in no noise, floor, RMSE or number of samples, and no row learns from them. Shape
// parameters start from the best of their grids, the gains being solved for at every point of a grid (variable
// projection); the best three starts are followed. A direction of the parameters that the data do not determine is left
// at its start and said.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "ballbar/model/model.hpp"
#include "ballbar/noise/noise.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

enum class ParameterState { free, held, on_lower_bound, on_upper_bound, undetermined };

struct FittedParameter {
  std::string effect;  // label of its term, "constant" for the constant
  std::string name, unit;
  double value = 0.0;
  double sigma = 0.0;  // NaN: held, on a bound, or too few values to tell it; infinite: undetermined
  ParameterState state = ParameterState::free;
  ParameterKind kind = ParameterKind::gain;
  ShapeOf shape_of = ShapeOf::curve;
};

struct FitOptions {
  bool robust = false;                        // Tukey's biweight
  bool white = false;                         // ordinary least squares: no noise model
  std::size_t starts = 3;                     // of the shape parameters
  std::optional<Noise> noise = std::nullopt;  // of the residual, known: not estimated
  // Of circles that linear axes drive, with a model of errors of the machine alone: every error has the value that it
  // has beside all of them, whether the model has them or not, and sigma by the noise that all leave
  // (machine_errors.hpp).
  bool among_all_errors = false;
};

struct Fit {
  std::string target;
  std::vector<double> time_s;                                  // n rows where the target has a value
  std::vector<std::size_t> row;                                // of the data, same order
  std::vector<double> measured_um, predicted_um, residual_um;  // residual = measured - predicted
  std::vector<double> sigma_um;                                // of the target as stated; empty: none
  std::vector<std::vector<double>> contribution_um;            // one a term: n values
  std::vector<FittedParameter> parameters;                     // constant first, then term by term
  Eigen::MatrixXd covariance;                                  // of all parameters, 0 for held ones
  Eigen::MatrixXd jacobian;                                    // n by parameters, um per unit, unweighted
  Noise noise;
  Floor floor;
  std::vector<std::size_t> discounted;  // robust: of the n rows, rising
  double n_effective = 0.0;             // of the rows that are not discounted, as RMSE, noise and floor
  double rmse_um = 0.0;
  bool converged = false;
  std::vector<std::string> remarks;  // whole sentences: more parameters than independent samples, on a bound ...
};

// Throws Error where the model does not suit the data (expect_suits), or the target has fewer than 3 values.
Fit fit(const Model& model, const Series& data, std::size_t target = 0, const FitOptions& options = {});

// Whether FitOptions::among_all_errors says anything: circles of one bar that linear axes drive, and a model of
// nothing but circles and errors of the machine, all gains free.
bool is_of_machine_errors(const Model& model, const Series& data);

// The model's series with the fit's parameters on any data that has its columns.
struct Prediction {
  std::vector<double> predicted_um;                  // one a row of the data
  std::vector<std::vector<double>> contribution_um;  // one a term
  std::vector<double> sigma_um;  // of predicted_um, by what the parameters scatter; empty: not asked
};
// covariance: of all parameters (Fit::covariance), for sigma_um; nullptr: without.
Prediction predict(const Model& model, const std::vector<FittedParameter>& parameters, const Series& data,
                   const Eigen::MatrixXd* covariance = nullptr);

}  // namespace ballbar
