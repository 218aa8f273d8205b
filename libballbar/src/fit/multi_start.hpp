// The starts of a fit: shape parameters from their grids, gains by linear least squares at every point.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/model_rows.hpp"

namespace ballbar {

// At most `count` parameter vectors, the best first. For each term in turn, twice, every point of its grid is tried
// with the gains of all terms solved. Shapes with a stated start, held ones, and those without a grid do not change. An
// onset is tried at the times of the data. O(points x rows).
std::vector<Eigen::VectorXd> starts(const Model& model, const ModelRows& rows, const Eigen::VectorXd& target_um,
                                    const Eigen::VectorXd& weight, std::size_t count);

}  // namespace ballbar
