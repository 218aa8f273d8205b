// Least squares of some columns over some rows.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "machine_errors/error_model.hpp"

namespace ballbar {

using Indices = std::vector<Eigen::Index>;
Indices range_of(Eigen::Index first, Eigen::Index count);

// Of a column's own square: so little of it that it is told apart all the same.
inline constexpr double kRidge = 1e-9;

// (X' W X + L)^-1 and W X, W the weights of the rows.
struct Block {
  Eigen::MatrixXd weighted;  // rows by columns
  Eigen::MatrixXd inverse;

  Eigen::VectorXd solve(const Eigen::VectorXd& data) const { return inverse * (weighted.transpose() * data); }
};
Block block_of(const Eigen::MatrixXd& columns, const Eigen::VectorXd& weight, const Eigen::MatrixXd& precision);
Eigen::MatrixXd inverse_of(Eigen::MatrixXd normal, const Eigen::MatrixXd& precision);

// Columns that say something in these readings.
ErrorColumns present(const ErrorColumns& all, const ErrorRows& rows);

// The shape of `shapes` whose columns lower most what is left of the data, freed of the columns of `base` (none: null).
struct Base {
  const Eigen::MatrixXd* columns = nullptr;
  const Block* fit = nullptr;
};
double best_shape(const Effect& effect, const std::vector<double>& shapes, const ErrorRows& rows, const Base& base,
                  const Eigen::VectorXd& left, const Eigen::VectorXd& weight);

}  // namespace ballbar
