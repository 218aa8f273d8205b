// Where a level changes, and how likely scatter alone would show as much at any place.
#pragma once

#include <Eigen/Core>
#include <span>

#include "history/scatter.hpp"
#include "history/series_judgement.hpp"

namespace ballbar {

struct StepSearch {
  StepPlace place;
  double p_value = 1.0;
};

inline constexpr std::size_t kFewestOfStep = 5;  // values; two on either side

// Of the difference of both sides' mean scores at one place, each clipped at kShortRunClip, on either side: where one
// side is short by what such means were, else by Student's t.
class StepScores {
 public:
  StepScores(const Eigen::VectorXd& scores, double degrees, const FamilyScatter& family);
  double p_value(std::size_t k) const;

 private:
  std::vector<double> sums_;
  double degrees_;
  const FamilyScatter& family_;
};

StepSearch step_search(const Eigen::VectorXd& scores, double degrees, const FamilyScatter& family);

}  // namespace ballbar
