// The most likely parameters of a model, from parameters near them, at one covariance.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "diagnosis/evidence/base_columns.hpp"
#include "diagnosis/evidence/evidence.hpp"
#include "noise/whitening.hpp"

namespace ballbar {

struct GaussNewtonFit {
  std::vector<double> parameters;
  double variance = 0.0;  // of the scatter, in units of C
  double square = 0.0;    // residual sum of squares of the white readings
};

// When to stop: after so many steps, or when a step lowers `square` by less than this share of the scatter.
struct Steps {
  int most = 12;
  double least_fall = 1e-3;  // accuracy of a search
};
inline constexpr Steps kToTheEnd{60, 1e-9};  // accuracy of printed numbers

// Gauss-Newton, with shapes within their bounds. times: columns of Kind::time. free: held shapes to set free; fixed: as
// in BaseModel::at().
GaussNewtonFit gauss_newton_fit(const BaseModel& base, std::vector<double> parameters,
                                const std::vector<std::size_t>& free, const Eigen::MatrixXd& times,
                                const Whitening& filter, const KnownScatter& known, Steps steps, std::size_t fixed = 0);

// The linear model of these columns in a pool with the order y, the columns, times.
Line line_of(const BaseColumns& columns, Eigen::Index times);
RowMajorMatrix pool_of(const BaseColumns& columns, const Eigen::MatrixXd& times);

}  // namespace ballbar
