// Ridge regression of a target on families of predictors, beside a discrepancy that remembers.
//
//   y = b + X~ w + e,   w ~ N(0, s^2 v P),   e ~ N(0, s^2 N),   b free
//   N = 0.98 exp(-|dt| / l) + 0.02 I         within a run; 0 between runs; l = 0: N = I
//   P = sum over families of sum_k c_k w_k w_k' / sum_k c_k
//
// Named terms of a model, as the design has them, join K by u X_m X_m': they are of no family, each has the variance u.
//
// X~ are the predictors less their means over their standard deviations; w_k is one of the members of a family, scaled
// by its own standard deviation, so that every family has the same prior variance. c_k is 1; of temperatures and their
// differences that standard deviation, half-way to equal gains in um/K: a temperature that hardly moved in training,
// and may in another run, has no large gain to explain what others do as well. So
//
//   K = v X~ P X~' + N,   b = 1'K^-1 y / q,   q = 1'K^-1 1,   E w = v P X~' K^-1 (y - b)
//
// The dictionary (which kinds of families), v, l and u, 0 or free (10 000), are those of the largest restricted
// likelihood where the rows are of few runs,
//
//   ln L = -(n-1)/2 ln(S/(n-1)) - (ln|K| + ln q)/2,   S = (y - b)'K^-1 (y - b),   s^2 = S/(n-1)
//
// and of five or more runs those that predict a run best from the others: with Q = K^-1 - K^-1 1 1'K^-1 / q the
// error of run R when it is left out is Q_RR^-1 (Q y)_R.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "predict/design.hpp"

namespace ballbar {

inline constexpr std::size_t kRidgeRows = 830;
inline constexpr std::size_t kChoiceRows = 415;  // where the setting is chosen again and again
inline constexpr std::size_t kPredictorKinds = 5;

struct RidgeSetting {
  unsigned kinds = 0;  // a bit each of PredictorKind
  double variance = 1.0;
  double length_s = 0.0;
  double named_variance = 0.0;  // u; 0: without the named terms
  double start_scale = 1.0;     // (s0 / s)^2
};

struct RidgeProblem {
  Eigen::VectorXd mean, sd;  // of the predictors; sd 0: stands still here, and is left out
  Eigen::MatrixXd columns;   // X~, n by p
  Eigen::VectorXd target_um;
  std::vector<double> time_s;
  std::vector<std::size_t> run;
  double end_s = 0.0;                  // time of the last row, thinned out or not
  std::vector<Eigen::MatrixXd> prior;  // P of each kind, p by p
  std::vector<std::size_t> named;      // predictors
  // Of all scaled gains before there are rows, where the design knows them; empty: none. target_um is less X~ start.
  Eigen::VectorXd start;
  Eigen::MatrixXd start_covariance;  // C0 over s0^2: p by p
  double start_sigma_um = 0.0;       // s0
};

// Of at most `most` of these rows of the design.
RidgeProblem ridge_problem(const Design& design, const std::vector<std::size_t>& rows, std::size_t most = kRidgeRows);

// v is found uphill from 1, and from 1000 where runs are left out.
RidgeSetting chosen_setting(const RidgeProblem& problem);
// The same for this u.
RidgeSetting chosen_setting(const RidgeProblem& problem, double named_variance);
inline constexpr double kFreeNamed = 1e4;

// N, n by n.
Eigen::MatrixXd discrepancy_of(const std::vector<double>& time_s, const std::vector<std::size_t>& run, double length_s);

// Covariance of the discrepancy at end_s with that of every row, over s^2.
Eigen::VectorXd discrepancy_at_end(const RidgeProblem& problem, double length_s);

// The share of the discrepancy's variance that is remembered after so long.
double remembered(double since_s, double length_s);

struct RidgeFit {
  RidgeSetting setting;
  double sigma_um = 0.0;          // s
  double log_likelihood = 0.0;    // restricted
  std::vector<std::size_t> used;  // predictors of the dictionary that do not stand still: m
  // Of b at the means, the w of these predictors, and what the discrepancy is in the last row, 0 for l = 0: m + 2.
  Eigen::VectorXd gains_um;
  Eigen::MatrixXd factor_um;  // L, lower: L L' is their covariance
};
RidgeFit ridge_fit(const RidgeProblem& problem, const RidgeSetting& setting);

// A regression on few effects (selection.cpp): the mean of nine such selections. As ridge_fit, over the predictors that
// any of the nine has chosen, at most 12 each: l = 1800, 7200 and 30 000 s, v = 1, 3 and 10; three with l = 0 where
// that is likelier. Its covariance is that of the mixture: the mean of theirs and how far their gains are apart. Memory
// and sigma are those of the likeliest.
RidgeFit few_effects(const RidgeProblem& problem);

inline constexpr std::size_t kFewestRunsToLeaveOut = 5;

// E w of all predictors from these rows of the problem alone.
Eigen::VectorXd gains_from(const RidgeProblem& problem, const RidgeSetting& setting,
                           const std::vector<std::size_t>& rows);

// How many of the last predictors in use are named.
std::size_t named_in(const RidgeProblem& problem, const RidgeFit& fit);

// Sum over the rows of the variance of what the gains add, over s^2, before there are rows.
double prior_trace(const RidgeProblem& problem, const RidgeSetting& setting);

// ln L without these predictors.
double log_likelihood_without(const RidgeProblem& problem, const RidgeSetting& setting,
                              const std::vector<std::size_t>& predictors);

// The error of every row when its run is left out, and the sigma that is expected of it.
struct LeftOutRuns {
  Eigen::VectorXd error_um, sigma_um;  // n
  std::vector<double> rmse_um;         // of each run that has rows in the problem
};
LeftOutRuns left_out_runs(const RidgeProblem& problem, const RidgeSetting& setting);

// Runs r by runs s of the design: the mean square of the error of run s when r and s are left out together, on the
// diagonal when s alone is; 0 where the problem has no row of s, infinite where K is singular.
Eigen::MatrixXd left_out_pairs_um2(const RidgeProblem& problem, const RidgeSetting& setting, std::size_t runs);

inline constexpr double kNormal95 = 1.959963984540054;  // sigmas of a 95 % interval

struct RidgePrediction {
  double mean_um = 0.0, sigma_um = 0.0;
};
// x: all predictors of a row, not scaled. since_s: after problem.end_s, in the last run; infinite: in another.
RidgePrediction ridge_prediction(const RidgeProblem& problem, const RidgeFit& fit,
                                 const Eigen::Ref<const Eigen::VectorXd>& x, double since_s);

}  // namespace ballbar
