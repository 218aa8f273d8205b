// Columns by the filter of the noise.
#pragma once

#include <Eigen/Core>

#include "ballbar/noise/noise.hpp"

namespace ballbar {

Eigen::MatrixXd whitened(const Whitening& whitening, const Eigen::Ref<const Eigen::MatrixXd>& columns);

// Student's t with 4 degrees of freedom is more likely than the normal distribution, each of its own most likely width.
bool has_heavy_tails(const Eigen::VectorXd& white);

}  // namespace ballbar
