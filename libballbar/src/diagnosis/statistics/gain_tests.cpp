#include "diagnosis/statistics/gain_tests.hpp"

#include <Eigen/QR>
#include <algorithm>

#include "ballbar/diagnosis/statistics/thresholds.hpp"
#include "noise/whitening.hpp"
#include "numerics/orthonormal.hpp"
#include "numerics/tails.hpp"

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
  const Eigen::VectorXd r = freed(Eigen::VectorXd(whitened(whitening, leftover.residual_um)), basis);
  const Eigen::MatrixXd left = freed(whitened(whitening, apart), basis);
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(left);
  qr.setThreshold(kOwnDirection);
  const Eigen::Index degrees = qr.rank();
  if (degrees == 0) return 1.0;
  const Eigen::MatrixXd directions = qr.householderQ() * Eigen::MatrixXd::Identity(left.rows(), degrees);
  return chi2_upper_tail((directions.transpose() * r).squaredNorm(), static_cast<std::size_t>(degrees));
}

double share_of_one_cycle(const Leftover& leftover, const Eigen::MatrixXd& columns, const Noise& noise,
                          const std::vector<std::size_t>& cycle) {
  const Whitening whitening = whitening_of(leftover, noise);
  const Eigen::MatrixXd basis = orthonormal(whitened(whitening, leftover.model));
  const Eigen::MatrixXd added = freed(whitened(whitening, columns), basis);
  std::vector<double> square(*std::max_element(cycle.begin(), cycle.end()) + 1, 0.0);
  for (std::size_t i = 0; i < cycle.size(); ++i)
    square[cycle[i]] += added.row(static_cast<Eigen::Index>(i)).squaredNorm();
  const double all = added.squaredNorm();
  return all > 0.0 ? *std::max_element(square.begin(), square.end()) / all : 0.0;
}

double gain_of_many(const Leftover& leftover, const Eigen::MatrixXd& columns, const Noise& noise) {
  const Whitening whitening = whitening_of(leftover, noise);
  const Freed model = freed_of(leftover, whitening);
  const Eigen::MatrixXd added = orthonormal(freed(whitened(whitening, columns), model.basis));
  const Eigen::VectorXd gains = added.transpose() * model.residual;
  return has_heavy_tails(model.residual - added * gains) ? (added.transpose() * clipped(model.residual)).squaredNorm()
                                                         : gains.squaredNorm();
}

}  // namespace ballbar
