#include "fit/linearised_fit.hpp"

#include <cmath>
#include <limits>

#include "noise/whitening.hpp"
#include "numerics/orthonormal.hpp"

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

std::vector<double> model_reach_um(const Fit& fit) {
  std::vector<double> reach;
  for (const Eigen::Index index : used_parameters(fit)) {
    const FittedParameter& parameter = fit.parameters[static_cast<std::size_t>(index)];
    const bool gain = parameter.kind == ParameterKind::gain;
    reach.push_back(gain ? std::numeric_limits<double>::infinity()
                         : std::abs(parameter.value) * fit.jacobian.col(index).norm());
  }
  return reach;
}

std::size_t first_parameter(const Model& model, std::size_t term) {
  std::size_t first = 1;
  for (std::size_t t = 0; t < term; ++t) first += model.terms[t].settings.size();
  return first;
}

Eigen::MatrixXd gain_columns(const Fit& fit, const Model& model, std::size_t term) {
  std::vector<Eigen::Index> gains;
  const std::vector<Parameter>& parameters = model.terms[term].effect->parameters;
  const std::size_t first = first_parameter(model, term);
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    if (parameters[k].kind == ParameterKind::gain) gains.push_back(static_cast<Eigen::Index>(first + k));
  }
  return fit.jacobian(Eigen::all, gains);
}

LinearisedFit linearised_fit_of(const Fit& fit) {
  return {fit.time_s, fit.sigma_um,
          Eigen::VectorXd::Map(fit.residual_um.data(), static_cast<Eigen::Index>(fit.residual_um.size())),
          model_columns(fit), model_reach_um(fit)};
}

Freed freed_of(const LinearisedFit& linearised) {
  Freed result{orthonormal(linearised.model), {}};
  result.residual = freed(linearised.residual_um, result.basis);
  return result;
}

Freed freed_of(const LinearisedFit& linearised, const Whitening& whitening) {
  Freed result{orthonormal(whitened(whitening, linearised.model)), {}};
  result.residual = freed(Eigen::VectorXd(whitened(whitening, linearised.residual_um)), result.basis);
  return result;
}

}  // namespace ballbar
