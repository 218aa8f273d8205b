// What every predictor is at the rows where the target is known.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "ballbar/series/series.hpp"
#include "effect_regression/predictors.hpp"

namespace ballbar {

inline constexpr std::size_t kMostDesignRows = 20'000;

// n rows, run by run in the order of time.
struct Design {
  Predictors predictors;
  Eigen::MatrixXd values;     // n by predictors, um of a gain of 1
  Eigen::VectorXd target_um;  // n
  std::vector<double> time_s;
  std::vector<std::size_t> run, row;  // of the runs, of its series
  std::size_t runs = 0;
};

// Of more than kMostDesignRows values of the target every second, third ... of a run. Throws Error as predictors_of and
// where the target is missing or has fewer than 40 values.
Design design_of(std::span<const Series> runs, const std::string& target, const Catalogue& catalogue);

// Every k-th of these rows, so that at most `most` (at least one) are left.
std::vector<std::size_t> thinned(const std::vector<std::size_t>& rows, std::size_t most);

}  // namespace ballbar
