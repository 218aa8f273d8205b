// The slow discrepancy after a search: what an unlogged driver adds, and what that looks like.
#pragma once

#include <Eigen/Core>
#include <string>

#include "diagnosis/posterior/posterior.hpp"

namespace ballbar {

// Its posterior mean, n readings, given the residual beside the model and the best set: K C^-1 r, K the covariance of
// the discrepancy. That is the kind of the set, or the most likely one if the set has none and a discrepancy is likely
// all the same (kDiscrepancy). 0 where there is none. O(n).
Eigen::VectorXd discrepancy_mean(const Problem& problem, const Posterior& posterior, const EffectSet& set);

// The effect of time alone whose curve it follows (R^2 of at least Tuning::follows), with its time; an empty effect:
// none.
struct Description {
  std::string effect;     // "settling"
  std::string parameter;  // "time constant"; empty: it has none
  double time_s = 0.0;
};
Description description_of(const Catalogue& catalogue, const Problem& problem, const Eigen::VectorXd& discrepancy_um);

}  // namespace ballbar
