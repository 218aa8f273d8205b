// The response of a column to speed, room and coolant, fitted to the data, to predict it in a planned test.
//
//   T(t) = c + sum a_j LP_j[n^p] + sum b_j LP_j[room] + sum c_j LP_j[coolant] + sum d_j exp(-t / s_j)
//
// LP_j are first-order low passes with time constants from 0 to 6 h, n is in krpm, p = 5/3 or, if it fits clearly
// better, 1 or 2. The fit is least squares with a, b, c >= 0, because added heat does not cool. This prevents large
// gains of opposite sign for similar low passes. The exponentials describe a machine that is not in equilibrium at the
// first row. A test begins in equilibrium, so that they are omitted from the prediction. R2 is the share of the rest
// that the drives explain. It is in-sample and too optimistic for a short record.
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
  double r2 = 0.0;        // 1 if the column is constant
};

// One per column. `values` may have gaps; a column with fewer than 8 values is not predicted (r2 = 0).
std::vector<Forecast> forecasts_of(const Drives& drives, const std::vector<std::vector<double>>& values);

// The drives must have the same members as those of the fit.
std::vector<double> predicted(const Forecast& forecast, const Drives& drives);

}  // namespace ballbar
