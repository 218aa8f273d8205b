// The design of the fit of a machine's errors, and the estimating equations that give its gains.
//
// A column of X is the curve of a unit error on the rows y. It has a weighted column in Z:
//
//   Z' (y - X b) = 0,      b = T Z' y,      T = (Z' X + L)^-1,      cov b = T Z' V Z T' + open
//
// With Z = W X this is least squares over the rows of weight W. The errors differ in the rows that tell them:
//
//   circles, errors of all readings   W: the readings farther than 1.5 deg from a reversal
//   cyclic errors                     W: the readings from 12 to 63 deg from their own axis' reversal
//   reversal spikes                   z = V^-1 x within 9 deg after their own reversal, V the noise of these rows; the
//                                     equations of the others leave them out
//
// L: a prior. open: what the prior, or the ridge of rounding, holds of a combination that no reading tells.
// Source: estimating equations and their sandwich covariance, H. White, Econometrica 48 (1980).
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "machine_errors/error_columns.hpp"

namespace ballbar {

using Indices = std::vector<Eigen::Index>;

// One effect of the fit.
struct FittedEffect {
  const Effect* effect = nullptr;
  std::optional<double> shape = {};
  double searched = 1.0;      // number of independent shapes tried
  double looked_at = 1.0;     // number of errors of its kind: the four spikes, or all others
  Indices columns = {};       // of the design
  bool in_the_fit = true;     // false: fitted separately, for inspection
  bool is_needed = true;      // false: a spike, and a step of another width explains it
  double p_with_prior = 0.0;  // p-value with the usual prior; 0: no prior
};

struct ErrorDesign {
  ErrorColumns x;
  Eigen::MatrixXd z;         // rows by columns
  Eigen::MatrixXd products;  // Z' X, 0 for a spike in the equations of the others
  std::vector<FittedEffect> effects;
};

// The kind of a column; the circles are fitted together with the errors of all readings.
ErrorFit kind_of(const ErrorColumn& column);
// Columns of some kinds, ascending.
Indices columns_of(const ErrorDesign& design, std::initializer_list<ErrorFit> kinds);
Indices all_of(const ErrorDesign& design);

// An effect, its columns and their Z; nullptr: circles.
struct EffectDesign {
  FittedEffect effect;
  ErrorColumns x;
  Eigen::MatrixXd z;
};
// W of the rows farther than 1.5 deg from a reversal.
Eigen::VectorXd far_weight(const ErrorRows& rows);
// Z = W X of rows with these weights.
EffectDesign weighted(FittedEffect effect, ErrorColumns x, const Eigen::VectorXd& weight);
// Adds those that have columns.
void add(ErrorDesign& design, const std::vector<EffectDesign>& effects);
// Takes off what was added last: the effects and columns of one kind.
void remove_last(ErrorDesign& design, ErrorFit kind);

// The products of some columns anew, after their x or z has changed.
void refresh(ErrorDesign& design, const Indices& changed);

struct GainEstimate {
  Indices columns;       // those estimated
  Eigen::MatrixXd t;     // b = t Z' y: columns by all of Z
  Eigen::MatrixXd open;  // of the covariance, for a slow variance of 1
  Eigen::MatrixXd held;  // combinations of the cyclic errors that are held at 0: cyclic columns by combinations
};
// Gains of some columns, ascending. prior: L of the first columns of the design. Each row of the cyclic errors is read
// where its own axis shows. A pitch of a quarter of the travel, or any pitch on a short arc, makes some combination of
// both axes' waves with the circle nearly singular. Such a combination is held at 0, by a truncated singular value
// decomposition (P. C. Hansen, BIT 27 (1987)) of what the others leave of these equations, scaled to unit curves.
GainEstimate gain_estimate(const ErrorDesign& design, const Indices& columns, const Eigen::MatrixXd& prior = {});

// (X' W X + ridge)^-1 of a symmetric X' W X.
Eigen::MatrixXd inverse_of(Eigen::MatrixXd normal);

// Whether the columns of one effect are relevant in the rows with these weights: not the far tail of a distant spike.
ErrorColumns present(const ErrorColumns& all, const Eigen::VectorXd& weight);

// The shape of the effect, of those given, whose columns lower the residual of the data most. `beside`: orthogonal to
// the columns of this estimate (nullptr: of none).
double best_shape(const Effect& effect, const std::vector<double>& shapes, const ErrorRows& rows,
                  const Eigen::VectorXd& left, const Eigen::VectorXd& weight, const ErrorDesign* design = nullptr,
                  const GainEstimate* beside = nullptr);

}  // namespace ballbar
