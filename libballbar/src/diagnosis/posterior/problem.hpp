// One diagnosis: the readings, the model, what an effect could add, and at which covariances the readings are likely.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ballbar/diagnosis/posterior/search_options.hpp"
#include "ballbar/fit/fit.hpp"
#include "ballbar/model/model.hpp"
#include "ballbar/series/series.hpp"
#include "diagnosis/evidence/base_columns.hpp"
#include "diagnosis/evidence/evidence.hpp"
#include "diagnosis/evidence/logged_inputs.hpp"
#include "diagnosis/signatures/signature_library.hpp"
#include "noise/noise_grid.hpp"
#include "noise/whitening.hpp"

namespace ballbar {

inline constexpr double kLogZero = -std::numeric_limits<double>::infinity();  // of a weight: none

// A parameter that the model holds, set free.
struct OwnParameter {
  std::size_t parameter = 0;  // by its place, the constant first
  double held = 0.0;
  std::vector<double> fitted;  // other values that a fit has found
};

// A covariance at which the readings are likely.
struct Point {
  Covariance covariance;
  Whitening filter;
};

struct Problem {
  Model model;
  LoggedInputs logged;
  Fit base;
  std::vector<double> time_s, relative_variance;
  std::vector<double> shock;                 // relative variance of what is new in the noise of a row
  std::vector<char> at_jump_of_temperature;  // of each row: about it a jump may be the temperature's
  Eigen::VectorXd y;                         // less `centre_um`, where a constant of the model is free
  double centre_um = 0.0;
  double highest_Hz = 0.0;  // half the rate of the rows
  KnownScatter known;
  std::unique_ptr<BaseModel> base_model;
  SignatureLibrary library;
  Eigen::MatrixXd signatures;              // n by all columns of the library, each of deviation 1
  Eigen::VectorXd deviation;               // of the library's columns before that
  std::size_t effects = 0;                 // families of effects; those behind them are inputs of any form
  std::vector<double> log_prior;           // of each family: effects alike, columns of an effect alike
  std::vector<double> log_prior_of_shape;  // of each signature in its family: alike, but half where it acts at once
  std::vector<OwnParameter> own;
  std::vector<Covariance> covariances;
  std::vector<Term> terms;  // given in the place of the catalogue's: what they hold is held
};

struct ProblemOptions {
  SearchOptions search;
  std::vector<Term> terms;              // as Problem::terms
  std::size_t most_rows = 1000;         // values of the target
  std::vector<double> whole_about_s;    // about these moments all of its values
  std::vector<Covariance> covariances;  // looked at; none: all of noise_grid, and the slow ones
};

Point point_at(const Problem& problem, const Covariance& covariance);

// Where the least-squares fit has the model's parameters, of readings less `centre_um`.
std::vector<double> fitted_parameters(const Problem& problem);

// Of the scatter: what a logger makes of readings of this size.
double least_variance_of(const Problem& problem);

// Row by row what the logs leave open of jumps: rows strictly inside the time of a jump; wide: those at its ends as
// well.
void free_rows_at_jumps(Problem& problem, bool wide);

// The family at another shape, a point for all parameters, put into the library; nothing: it adds nothing there, or
// what is there already.
std::optional<std::size_t> add_signature(Problem& problem, std::size_t family, const std::vector<double>& point);

// The term of an effect as it is given, else as the catalogue has it.
Term term_of(const Problem& problem, const BoundEffect& bound);

// Throws Error as fit does.
std::unique_ptr<Problem> problem_of(const Model& model, const Series& data, std::size_t target,
                                    const ProblemOptions& options);

}  // namespace ballbar
