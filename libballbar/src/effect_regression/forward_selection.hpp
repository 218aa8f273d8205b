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
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

namespace ballbar {

struct SelectionState {
  double length_s = 0.0;  // l
  double variance = 1.0;  // v
};

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

// At most `most`, also such as need not be there: how many are wanted is for the caller.
PredictorSelection forward_selection(const SelectionProblem& problem, std::span<const SelectionState> states,
                                     std::size_t most);

// 600, 1800, 7200 and 30 000 s, v from 0.3 to 10.
std::span<const SelectionState> all_selection_states();

}  // namespace ballbar
