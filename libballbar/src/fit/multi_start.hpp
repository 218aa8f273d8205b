// Where a fit starts: shape parameters from their grids, gains by linear least squares at every point.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/model_rows.hpp"

namespace ballbar {

// At most `count` parameter vectors, the best first. Term by term, twice round, every point of the term's grid is tried
// with the gains of all terms solved for; a shape that the user started, a held one, and one without a grid stay. An
// onset is tried at the data's times. O(points x rows).
std::vector<Eigen::VectorXd> starts(const Model& model, const ModelRows& rows, const Eigen::VectorXd& target_um,
                                    const Eigen::VectorXd& weight, std::size_t count);

}  // namespace ballbar
