// Sets of errors that the readings show together and cannot separate.
//
// In the fit of all, the gains of a set are correlated by more than 0.9 and none is significant; in the fit without the
// other members each one is. An error that does not explain the readings alone is no member.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "machine_errors/error_design.hpp"

namespace ballbar {

struct FittedGroup {
  std::vector<std::size_t> effects;         // indices into ErrorDesign::effects
  std::vector<Eigen::VectorXd> alone;       // the gains of each, if it is the only one
  std::vector<Eigen::MatrixXd> covariance;  // of these
  double p = 1.0;
};

// Values and their covariance.
struct Gains {
  Eigen::VectorXd values;
  Eigen::MatrixXd covariance;
};

// p-value of these gains: all together (chi^2), or the most significant one.
double p_of(const Eigen::VectorXd& values, const Eigen::MatrixXd& covariance);
// The same of one effect, corrected for the shapes tried and the errors looked at. gains: of these columns, ascending.
double corrected_p(const FittedEffect& effect, const Gains& gains, const Indices& columns);

// Significance level for one effect among `looked_at`: 1 % that any of a kind is found in noise.
inline constexpr double kFalseErrors = 0.01;

// all: gains of `whole`, the columns of the fit of all but the spikes. chosen: the columns of the fit. gains_of: the
// fits of some columns by which an error must be significant, that whose values count first.
std::vector<FittedGroup> inseparable(const ErrorDesign& design, const Gains& all, const Indices& whole,
                                     const Indices& chosen,
                                     const std::function<std::vector<Gains>(const Indices&)>& gains_of);

}  // namespace ballbar
