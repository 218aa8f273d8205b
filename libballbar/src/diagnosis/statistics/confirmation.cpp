#include "diagnosis/statistics/confirmation.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <unsupported/Eigen/SpecialFunctions>

#include "diagnosis/signatures/bank.hpp"
#include "noise/whitened.hpp"

namespace ballbar {
namespace {

Whitening whitening_of(const Leftover& leftover, const Noise& noise) {
  return {noise, leftover.time_s, leftover.sigma_um};
}

}  // namespace

double chi2(const Leftover& leftover, const Noise& noise) {
  const Whitening whitening = whitening_of(leftover, noise);
  const Eigen::MatrixXd basis = orthonormal(whitened(whitening, leftover.model));
  const Eigen::VectorXd r = whitened(whitening, leftover.residual_um);
  return r.squaredNorm() - (basis.transpose() * r).squaredNorm();
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

double p_same_gain(const Leftover& leftover, const Eigen::MatrixXd& columns, const Noise& noise,
                   const std::vector<std::size_t>& cycle) {
  const auto cycles = static_cast<Eigen::Index>(*std::max_element(cycle.begin(), cycle.end()) + 1);
  const Whitening whitening = whitening_of(leftover, noise);
  Eigen::MatrixXd together(columns.rows(), leftover.model.cols() + columns.cols());
  together << leftover.model, columns;
  Eigen::MatrixXd apart = Eigen::MatrixXd::Zero(columns.rows(), columns.cols() * cycles);
  for (std::size_t i = 0; i < cycle.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    apart.block(row, static_cast<Eigen::Index>(cycle[i]) * columns.cols(), 1, columns.cols()) = columns.row(row);
  }
  const Eigen::MatrixXd basis = orthonormal(whitened(whitening, together));
  Eigen::VectorXd r = whitened(whitening, leftover.residual_um);
  r -= basis * (basis.transpose() * r);
  Eigen::MatrixXd left = whitened(whitening, apart);
  left -= basis * (basis.transpose() * left);
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(left);
  qr.setThreshold(1e-3);
  const Eigen::Index degrees = qr.rank();
  if (degrees == 0) return 1.0;
  const Eigen::MatrixXd directions = qr.householderQ() * Eigen::MatrixXd::Identity(left.rows(), degrees);
  return Eigen::numext::igammac(0.5 * static_cast<double>(degrees), 0.5 * (directions.transpose() * r).squaredNorm());
}

double share_of_one_cycle(const Leftover& leftover, const Eigen::MatrixXd& columns, const Noise& noise,
                          const std::vector<std::size_t>& cycle) {
  const Whitening whitening = whitening_of(leftover, noise);
  const Eigen::MatrixXd basis = orthonormal(whitened(whitening, leftover.model));
  Eigen::MatrixXd added = whitened(whitening, columns);
  added -= basis * (basis.transpose() * added);
  std::vector<double> square(*std::max_element(cycle.begin(), cycle.end()) + 1, 0.0);
  for (std::size_t i = 0; i < cycle.size(); ++i)
    square[cycle[i]] += added.row(static_cast<Eigen::Index>(i)).squaredNorm();
  const double all = added.squaredNorm();
  return all > 0.0 ? *std::max_element(square.begin(), square.end()) / all : 0.0;
}

double gain_of_many(const Leftover& leftover, const Eigen::MatrixXd& columns, const Noise& noise) {
  const Whitening whitening = whitening_of(leftover, noise);
  const Eigen::MatrixXd basis = orthonormal(whitened(whitening, leftover.model));
  Eigen::MatrixXd added = whitened(whitening, columns);
  added -= basis * (basis.transpose() * added);
  added = orthonormal(added);
  Eigen::VectorXd r = whitened(whitening, leftover.residual_um);
  r -= basis * (basis.transpose() * r);
  const Eigen::VectorXd gains = added.transpose() * r;
  return has_heavy_tails(r - added * gains) ? (added.transpose() * clipped(std::move(r))).squaredNorm()
                                            : gains.squaredNorm();
}

}  // namespace ballbar
