#include "fit/model_columns.hpp"

namespace ballbar {

std::vector<Eigen::Index> used_parameters(const Fit& fit) {
  std::vector<Eigen::Index> used;
  for (std::size_t k = 0; k < fit.parameters.size(); ++k) {
    const auto index = static_cast<Eigen::Index>(k);
    if (fit.parameters[k].state != ParameterState::held && fit.jacobian.col(index).norm() > 0.0) used.push_back(index);
  }
  return used;
}

Eigen::MatrixXd model_columns(const Fit& fit) {
  const std::vector<Eigen::Index> used = used_parameters(fit);
  Eigen::MatrixXd columns(fit.jacobian.rows(), static_cast<Eigen::Index>(used.size()));
  for (std::size_t j = 0; j < used.size(); ++j) {
    columns.col(static_cast<Eigen::Index>(j)) = fit.jacobian.col(used[j]).normalized();
  }
  return columns;
}

}  // namespace ballbar
