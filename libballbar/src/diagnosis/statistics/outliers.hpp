// Where the readings lie that are far from the others.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "ballbar/series/series.hpp"

namespace ballbar {

// Of white noise: readings beyond 4 sigma, and how many of them lie within 10 min after a change of speed.
struct Outliers {
  std::size_t count = 0, after_changes = 0;
  double p = 1.0;  // chance of as many after changes if they lay anywhere
};
Outliers outliers(const Eigen::VectorXd& white, const Series& data, const std::vector<std::size_t>& rows);

}  // namespace ballbar
