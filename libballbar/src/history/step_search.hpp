// Where a level changes, and how likely scatter alone would show as much at any place.
#pragma once

#include <Eigen/Core>
#include <span>

#include "history/fleet_scatter.hpp"
#include "history/series_judgement.hpp"

namespace ballbar {

struct StepSearch {
  StepPlace place;
  double p_value = 1.0;
};

inline constexpr std::size_t kFewestOfStep = 5;  // values; two on either side

// Of the difference of both sides' mean scores at one place, on either side: of short sides by what such sums were seen
// to be, of long ones by Student's t of scores clipped at kHuberClip.
class StepScores {
 public:
  StepScores(const Eigen::VectorXd& scores, double degrees, const FamilyScatter& family);
  double p_value(std::size_t k) const;

 private:
  double mean(const std::vector<double>& sums, std::size_t from, std::size_t to) const;

  std::vector<double> short_sums_, long_sums_;
  double degrees_;
  const FamilyScatter& family_;
};

StepSearch step_search(const Eigen::VectorXd& scores, double degrees, const FamilyScatter& family);

}  // namespace ballbar
