// Standard deviation of the values of a column.
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace ballbar {

// Of all values, the root of their mean square about the mean.
template <class Column>
double standard_deviation(const Eigen::MatrixBase<Column>& column) {
  const double mean = column.mean();
  return std::sqrt((column.array() - mean).square().mean());
}

}  // namespace ballbar
