#include "fit/fit_uncertainty.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <vector>

#include "ballbar/message_catalogue.hpp"
#include "numerics/not_finite.hpp"

namespace ballbar {
namespace {

constexpr double kNoInformation = 1e-11;  // eigenvalue of the scaled information, of the largest

bool on_bound(double value, double bound, double start) {
  return std::isfinite(bound) && std::abs(value - bound) <= 1e-6 * std::max({std::abs(bound), std::abs(start), 1e-6});
}

// W C W x for the covariance C of the noise and weights W: the exponential part by two recursions, O(n).
Eigen::MatrixXd noise_times(const Fit& result, const Eigen::VectorXd& weights, const Eigen::MatrixXd& columns) {
  const Eigen::Index n = columns.rows();
  const Noise& noise = result.noise;
  Eigen::MatrixXd x = weights.asDiagonal() * columns;
  Eigen::MatrixXd out(n, columns.cols());
  Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(columns.cols());
  const auto decay = [&](Eigen::Index i) {
    const auto row = static_cast<std::size_t>(i);
    const double step_s = result.time_s[row] - result.time_s[row - 1];
    return step_s < 0.0 ? 0.0 : std::exp(-step_s / noise.correlation_time_s);  // another run
  };
  for (Eigen::Index i = 0; i < n; ++i) {
    if (i > 0) sum = decay(i) * (sum + x.row(i - 1));
    out.row(i) = sum + x.row(i);
  }
  sum.setZero();
  for (Eigen::Index i = n - 1; i >= 0; --i) {
    if (i + 1 < n) sum = decay(i + 1) * (sum + x.row(i + 1));
    out.row(i) += sum;
  }
  out *= noise.correlated_um * noise.correlated_um;
  for (Eigen::Index i = 0; i < n; ++i) {
    const double sigma = result.sigma_um.empty() ? 0.0 : result.sigma_um[static_cast<std::size_t>(i)];
    out.row(i) += (noise.white_um * noise.white_um + sigma * sigma) * x.row(i);
  }
  return weights.asDiagonal() * out;
}

// `weights` null: the rows are whitened.
void add(Fit& result, const Eigen::MatrixXd& jacobian, const Bounds& bounds, double variance,
         const Eigen::VectorXd* weights) {
  std::vector<Eigen::Index> used;
  for (std::size_t k = 0; k < result.parameters.size(); ++k) {
    FittedParameter& parameter = result.parameters[k];
    const auto index = static_cast<Eigen::Index>(k);
    parameter.sigma = kUnknown;
    if (bounds.held[k]) {
      parameter.state = ParameterState::held;
    } else if (on_bound(parameter.value, bounds.lower[index], parameter.value)) {
      parameter.state = ParameterState::on_lower_bound;
    } else if (on_bound(parameter.value, bounds.upper[index], parameter.value)) {
      parameter.state = ParameterState::on_upper_bound;
    } else {
      used.push_back(index);
    }
  }
  const auto count = static_cast<Eigen::Index>(result.parameters.size());
  result.covariance = Eigen::MatrixXd::Zero(count, count);
  if (used.empty()) return;
  const auto m = static_cast<Eigen::Index>(used.size());
  Eigen::MatrixXd columns(jacobian.rows(), m);
  for (Eigen::Index j = 0; j < m; ++j) columns.col(j) = jacobian.col(used[static_cast<std::size_t>(j)]);
  const Eigen::VectorXd scale = columns.colwise().norm();
  const double largest = scale.maxCoeff();
  for (Eigen::Index j = 0; j < m; ++j) columns.col(j) /= scale[j] > 1e-14 * largest ? scale[j] : kInfinite;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(Eigen::MatrixXd(columns.transpose() * columns));
  Eigen::MatrixXd inverse = Eigen::MatrixXd::Zero(m, m);
  Eigen::VectorXd lost = Eigen::VectorXd::Zero(m);  // share of each parameter in directions without information
  for (Eigen::Index i = 0; i < m; ++i) {
    const Eigen::VectorXd direction = eigen.eigenvectors().col(i);
    if (eigen.eigenvalues()[i] > kNoInformation * eigen.eigenvalues()[m - 1]) {
      inverse += direction * direction.transpose() / eigen.eigenvalues()[i];
    } else {
      lost += direction.cwiseAbs2();
    }
  }
  if (weights != nullptr) inverse = inverse * (columns.transpose() * noise_times(result, *weights, columns)) * inverse;
  for (Eigen::Index j = 0; j < m; ++j) {
    const Eigen::Index row = used[static_cast<std::size_t>(j)];
    FittedParameter& parameter = result.parameters[static_cast<std::size_t>(row)];
    if (lost[j] > 1e-6) {
      parameter.state = ParameterState::undetermined;
      parameter.sigma = kInfinite;
      continue;
    }
    for (Eigen::Index i = 0; i < m; ++i) {
      if (lost[i] > 1e-6) continue;
      const Eigen::Index column = used[static_cast<std::size_t>(i)];
      result.covariance(row, column) = variance * inverse(j, i) / (scale[j] * scale[i]);
    }
    parameter.sigma = std::sqrt(result.covariance(row, row));
  }
}

void widen_onsets(Fit& result) {
  if (!std::is_sorted(result.time_s.begin(), result.time_s.end())) return;  // of several runs: in each
  for (FittedParameter& parameter : result.parameters) {
    if (parameter.shape_of != ShapeOf::onset || parameter.state == ParameterState::held) continue;
    const auto after = std::lower_bound(result.time_s.begin(), result.time_s.end(), parameter.value);
    if (after == result.time_s.begin() || after == result.time_s.end()) continue;
    const double between_s = *after - *(after - 1);
    if (parameter.state == ParameterState::free && std::isnan(parameter.sigma)) continue;
    if (parameter.state == ParameterState::undetermined) parameter.sigma = 0.0;
    parameter.state = ParameterState::free;
    parameter.sigma = std::max(std::isnan(parameter.sigma) ? 0.0 : parameter.sigma, between_s / std::sqrt(3.0));
  }
}

}  // namespace

void add_uncertainty(Fit& result, const Eigen::MatrixXd& jacobian, const Bounds& bounds, double variance) {
  add(result, jacobian, bounds, variance, nullptr);
  widen_onsets(result);
}

void add_uncertainty_under_noise(Fit& result, const Eigen::MatrixXd& jacobian, const Bounds& bounds,
                                 const Eigen::VectorXd& weights) {
  add(result, jacobian, bounds, 1.0, &weights);
  widen_onsets(result);
}

void add_remarks(Fit& result, std::size_t free) {
  std::vector<Paragraph>& remarks = result.remarks;
  for (const FittedParameter& parameter : result.parameters) {
    const EffectLabel effect{parameter.effect};
    const auto bound = [&] { return fmt::format("{:g} {}", parameter.value, parameter.unit); };
    if (parameter.state == ParameterState::undetermined)
      remarks.emplace_back(messages::fit_undetermined(parameter.name, effect));
    if (parameter.state == ParameterState::on_lower_bound)
      remarks.emplace_back(messages::fit_on_lower_bound(parameter.name, effect, bound()));
    if (parameter.state == ParameterState::on_upper_bound)
      remarks.emplace_back(messages::fit_on_upper_bound(parameter.name, effect, bound()));
  }
  const std::size_t kept = result.residual_um.size() - result.discounted.size();
  if (result.sigma_um.empty() && kept < free + kFewestLeft)
    remarks.emplace_back(messages::fit_sigma_unknown(kept, free));
  const bool too_many = static_cast<double>(free) > result.n_effective;
  if (too_many)
    remarks.emplace_back(messages::fit_too_many_parameters(free, fmt::format("{:.1f}", result.n_effective), kept));
  if (3 * free > kept && !too_many) remarks.emplace_back(messages::fit_many_parameters(free, kept));
  if (!result.converged) remarks.emplace_back(messages::fit_not_converged());
}

}  // namespace ballbar
