// One diagnosis problem: the readings, the model, the signatures of all effects, and the likely covariances.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "ballbar/diagnosis/signatures/search.hpp"
#include "ballbar/fit/fit.hpp"
#include "ballbar/model/model.hpp"
#include "ballbar/series/series.hpp"
#include "diagnosis/evidence/base_model.hpp"
#include "diagnosis/evidence/linear_model.hpp"
#include "diagnosis/evidence/logged_inputs.hpp"
#include "diagnosis/signatures/signature_library.hpp"
#include "noise/linear_filter.hpp"
#include "noise/whitening.hpp"

namespace ballbar {

inline constexpr double kLogZero = -std::numeric_limits<double>::infinity();  // of a weight: none

// A held parameter of the model.
struct HeldParameter {
  std::size_t parameter = 0;  // index, the constant first
  double value = 0.0;
};

// A likely covariance of the readings.
struct NoiseFilter {
  Covariance covariance;
  Whitening whitening;
};

// A row from which the target has another level.
struct LevelJump {
  std::size_t row = 0;
  double size_um = 0.0;
};

struct Problem {
  Tuning tuning;
  Model model;
  LoggedInputs logged;
  Fit base;
  std::vector<double> time_s;
  std::set<std::size_t> rows_of_faults;      // of saturated and stuck sensors; empty: none, or too many
  std::vector<double> stated_variance;       // kUnknownVariance of rows without information, else 0
  std::vector<double> relative_variance;     // of the white noise; larger for readings far from the others
  std::vector<LevelJump> level_jumps;        // of the target, none of them an effect
  double longest_memory_s = 0.0;             // of the noise
  std::vector<char> at_jump_of_temperature;  // per row: a jump near it may be one of a temperature
  Eigen::VectorXd y;                         // minus `centre_um`, if the constant of the model is free
  double centre_um = 0.0;
  double highest_Hz = 0.0;  // half the rate of the rows
  KnownScatter known;
  std::unique_ptr<BaseModel> base_model;
  SignatureLibrary library;                // each column with standard deviation 1, and room for more of them
  Eigen::VectorXd deviation;               // of each column before scaling
  std::size_t effects = 0;                 // number of families of effects; inputs of any form follow
  std::vector<double> log_prior;           // of each family (priors.hpp)
  std::vector<double> log_prior_of_shape;  // per signature in its family
  std::vector<HeldParameter> held;
  std::vector<Covariance> covariances;
  std::vector<Term> terms;  // replace the catalogue's terms; their held parameters stay held
};

struct ProblemOptions {
  SearchOptions search;
  std::vector<Term> terms;               // as Problem::terms
  std::size_t most_rows = 1000;          // values of the target
  std::vector<double> whole_about_s;     // use all values near these moments
  std::vector<Covariance> covariances;   // given ones; empty: they are found
  const LoggedInputs* logged = nullptr;  // of these data, target and options; null: they are made
};

// The values of the target that an inference uses, with the inputs as they were.
LoggedInputs logged_inputs_of(const Model& model, const Series& data, std::size_t target,
                              const ProblemOptions& options);

// Readings of the target in which its sensor stands at the end of its range, or is stuck.
std::vector<std::size_t> clipped_readings(const Fit& base, const Tuning& tuning);
std::vector<std::size_t> stuck_readings(const Fit& base, const Tuning& tuning);

NoiseFilter noise_filter_at(const Problem& problem, const Covariance& covariance);

// The parameters of the model in the least squares fit, for readings minus `centre_um`.
std::vector<double> fitted_parameters(const Problem& problem);

// The largest number of single effects; 0: the readings are too few for one.
std::size_t largest_sum(const Problem& problem);

// Whether all readings are the same.
bool is_still(const Problem& problem);

// The smallest variance of the scatter, from the rounding of readings of this size.
double least_variance_of(const Problem& problem);

// Columns of open levels are added to the open ones of the model: each a step of the jump's size.
Eigen::MatrixXd with_levels(const Problem& problem, Eigen::MatrixXd open);

// Adds the family at another shape (a point for all parameters) to the library; nullopt: it has no effect there, or
// exists already.
std::optional<std::size_t> add_signature(Problem& problem, std::size_t family, const std::vector<double>& point);

// The term of an effect that the caller has given; nullptr: none.
const Term* given_term(const Problem& problem, const BoundEffect& bound);

// The given term of an effect, else that of the catalogue.
Term term_of(const Problem& problem, const BoundEffect& bound);

// Throws Error as fit does.
std::unique_ptr<Problem> problem_of(const Model& model, const Series& data, std::size_t target,
                                    const ProblemOptions& options);

}  // namespace ballbar
