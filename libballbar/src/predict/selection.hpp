// Predictors chosen one by one, the gains of all of them together.
//
//   y = F a + sum_j b_j x_j + e,   b_j ~ N(0, s^2 v),   e ~ N(0, s^2 N),   a free      (N: ridge.hpp)
//
// Nothing is chosen among the states (l, v): all are carried along. A predictor j that joins raises the restricted
// likelihood of a state by
//
//   -(n-f)/2 ln(1 - v q_j^2 / ((1 + v d_j) S)) - 1/2 ln(1 + v d_j),   q_j = z_j'P r,  d_j = z_j'P z_j,  S = r'P r
//
// z_j and r whitened and freed of F, P = I - sum w w' v / (1 + v g) over those that have joined (w = P z, g = z'w). The
// predictor of the largest mean over the states joins; gains are means over the states too. Whether any more is needed:
//
//   P(none) = 1 / (1 + mean over the predictors of exp of that rise)
//
// few_effects is a regression of few effects: nine such selections, each as far as P(none) says, and the mean of what
// they predict.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "predict/ridge.hpp"

namespace ballbar {

struct SelectionProblem {
  Eigen::MatrixXd fixed;      // F, n by f
  Eigen::MatrixXd columns;    // n by p, scaled
  Eigen::VectorXd target_um;  // n
  std::vector<double> time_s;
  std::vector<std::size_t> run;
  double end_s = 0.0;  // time of the last row there is, which need not be one of these
};

struct Selected {
  std::size_t column = 0;
  double log_bayes = 0.0;  // the rise of ln L
  double p_none = 0.0;     // before it joined
};

// After so many predictors have joined, means over the states.
struct SelectedFit {
  Eigen::VectorXd gains;           // of F, then in the order of joining
  double end_um = 0.0;             // what the discrepancy is in the last row
  Eigen::MatrixXd covariance_um2;  // of the gains, and of that; of the first state
  double sigma_um = 0.0;           // s
};

struct PredictorSelection {
  std::vector<Selected> joined;
  std::vector<SelectedFit> fits;  // one more than joined
  double log_likelihood = 0.0;    // ln L of the first state before any joins
};

// At most `most`, also such as need not be there: how many are wanted is for the caller. Of the states l and v count.
PredictorSelection forward_selection(const SelectionProblem& problem, std::span<const RidgeSetting> states,
                                     std::size_t most);

// Of each length l every v.
std::vector<RidgeSetting> selection_states(std::span<const double> lengths_s, std::span<const double> variances);

inline constexpr double kNotNeeded = 0.5;         // P(none)
inline constexpr std::size_t kMostSelected = 12;  // of a selection

// As ridge_fit, over the predictors that any of the nine has chosen, at most 12 each: l = 1800, 7200 and 30 000 s, v =
// 1, 3 and 10; three with l = 0 where that is likelier. Its covariance is that of the mixture: the mean of theirs and
// how far their gains are apart. Memory and sigma are those of the likeliest.
RidgeFit few_effects(const RidgeProblem& problem);

}  // namespace ballbar
