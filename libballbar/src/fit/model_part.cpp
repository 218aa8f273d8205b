#include "ballbar/internal/fit/model_part.hpp"

#include <Eigen/QR>

namespace ballbar {
namespace {

Eigen::MatrixXd free_columns(const Fit& fit) {
  std::vector<Eigen::Index> free;
  for (std::size_t k = 0; k < fit.parameters.size(); ++k) {
    const auto column = static_cast<Eigen::Index>(k);
    const bool moves = fit.parameters[k].state == ParameterState::free && fit.jacobian.col(column).norm() > 0.0;
    if (moves) free.push_back(column);
  }
  Eigen::MatrixXd columns = fit.jacobian(Eigen::all, free);
  columns.colwise().normalize();
  return columns;
}

}  // namespace

std::vector<std::vector<double>> model_parts_um(const Fit& fit, const std::vector<std::vector<double>>& curves_um) {
  const Eigen::MatrixXd free = free_columns(fit);
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> solver(free.rows(), free.cols());
  if (free.cols() > 0) solver.compute(free);
  std::vector<std::vector<double>> parts;
  for (const std::vector<double>& curve : curves_um) {
    std::vector<double>& part = parts.emplace_back(curve.size(), 0.0);
    if (free.cols() == 0 || curve.empty()) continue;
    const auto n = static_cast<Eigen::Index>(curve.size());
    Eigen::VectorXd::Map(part.data(), n) = free * solver.solve(Eigen::VectorXd::Map(curve.data(), n));
  }
  return parts;
}

}  // namespace ballbar
