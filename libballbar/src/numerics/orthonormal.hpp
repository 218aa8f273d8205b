// Columns as an orthonormal basis of what they span, and what of others lies outside it.
#pragma once

#include <Eigen/Core>

namespace ballbar {

// n by the rank of the columns.
Eigen::MatrixXd orthonormal(const Eigen::MatrixXd& columns);

// (I - B B') x: what no sum of the orthonormal columns of the basis makes.
Eigen::VectorXd orthogonal_part(Eigen::VectorXd column, const Eigen::MatrixXd& basis);
Eigen::MatrixXd orthogonal_part(Eigen::MatrixXd columns, const Eigen::MatrixXd& basis);

// Each column freed of those before it and scaled to unit length (Gram and Schmidt); 0 where at most the share
// `nothing` of its square `before` is left. Result: the squares that were left.
Eigen::RowVectorXd orthonormalise(Eigen::Ref<Eigen::MatrixXd> columns, const Eigen::RowVectorXd& before,
                                  double nothing);

}  // namespace ballbar
