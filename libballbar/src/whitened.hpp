// Columns by the filter of the noise.
#pragma once

#include <Eigen/Core>

#include "ballbar/noise.hpp"

namespace ballbar {

Eigen::MatrixXd whitened(const Whitening& whitening, const Eigen::MatrixXd& columns);

}  // namespace ballbar
