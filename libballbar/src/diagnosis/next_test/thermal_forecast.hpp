// How a column follows speed, room and coolant, learned from the data, to predict it in a test that was not made yet.
//
//   T(t) = c + sum a_j LP_j[n^p] + sum b_j LP_j[room] + sum c_j LP_j[coolant] + sum d_j exp(-t / s_j)
//
// LP_j first-order low passes with time constants from 0 to 6 h, n in krpm, p = 5/3 or, if it fits clearly better, 1 or
// 2; least squares with a, b, c >= 0, as nothing cools where heat is added: that keeps neighbouring low passes, which
// look alike, from large gains of opposite sign. The exponentials stand for a machine that was not in equilibrium at
// the first row; a test begins in equilibrium, so they are dropped from the prediction, and R2 is the share of what
// they leave that the drives explain. In sample: on a short record it flatters.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace ballbar {

struct Drives {
  std::vector<double> time_s;   // n rows
  std::vector<double> speed;    // rpm; empty: none
  std::vector<double> room;     // degC; empty: none
  std::vector<double> coolant;  // degC; empty: none
};

struct Forecast {
  double exponent = 1.0;
  Eigen::VectorXd gains;  // c first
  double r2 = 0.0;        // 1 where the column is constant
};

// One a column. `values` may have gaps; a column with fewer than 8 values is not predicted (r2 = 0).
std::vector<Forecast> forecasts_of(const Drives& drives, const std::vector<std::vector<double>>& values);

// On drives that have the same members as those it was learned from.
std::vector<double> predicted(const Forecast& forecast, const Drives& drives);

}  // namespace ballbar
