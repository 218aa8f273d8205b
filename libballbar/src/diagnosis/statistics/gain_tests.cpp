#include "diagnosis/statistics/gain_tests.hpp"

#include <Eigen/QR>
#include <algorithm>

#include "ballbar/diagnosis/statistics/thresholds.hpp"
#include "noise/whitening.hpp"
#include "numerics/orthonormal.hpp"
#include "numerics/tails.hpp"

namespace ballbar {
namespace {

Whitening whitening_of(const LinearisedFit& linearised, const Noise& noise) {
  return {noise, linearised.time_s, linearised.sigma_um};
}

}  // namespace

double chi2(const LinearisedFit& linearised, const Noise& noise) {
  const Whitening whitening = whitening_of(linearised, noise);
  const Eigen::MatrixXd basis = orthonormal(whitened(whitening, linearised.model));
  const Eigen::VectorXd r = whitened(whitening, linearised.residual_um);
  return r.squaredNorm() - (basis.transpose() * r).squaredNorm();
}

double p_same_gain(const LinearisedFit& linearised, const Eigen::MatrixXd& columns, const Noise& noise,
                   const std::vector<std::size_t>& fold) {
  const auto folds = static_cast<Eigen::Index>(*std::max_element(fold.begin(), fold.end()) + 1);
  const Whitening whitening = whitening_of(linearised, noise);
  Eigen::MatrixXd together(columns.rows(), linearised.model.cols() + columns.cols());
  together << linearised.model, columns;
  Eigen::MatrixXd apart = Eigen::MatrixXd::Zero(columns.rows(), columns.cols() * folds);
  for (std::size_t i = 0; i < fold.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    apart.block(row, static_cast<Eigen::Index>(fold[i]) * columns.cols(), 1, columns.cols()) = columns.row(row);
  }
  const Eigen::MatrixXd basis = orthonormal(whitened(whitening, together));
  const Eigen::VectorXd r = freed(Eigen::VectorXd(whitened(whitening, linearised.residual_um)), basis);
  const Eigen::MatrixXd left = freed(whitened(whitening, apart), basis);
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(left);
  qr.setThreshold(kOwnDirection);
  const Eigen::Index degrees = qr.rank();
  if (degrees == 0) return 1.0;
  const Eigen::MatrixXd directions = qr.householderQ() * Eigen::MatrixXd::Identity(left.rows(), degrees);
  return chi2_upper_tail((directions.transpose() * r).squaredNorm(), static_cast<std::size_t>(degrees));
}

double share_of_one_fold(const LinearisedFit& linearised, const Eigen::MatrixXd& columns, const Noise& noise,
                         const std::vector<std::size_t>& fold) {
  const Whitening whitening = whitening_of(linearised, noise);
  const Eigen::MatrixXd basis = orthonormal(whitened(whitening, linearised.model));
  const Eigen::MatrixXd added = freed(whitened(whitening, columns), basis);
  std::vector<double> square(*std::max_element(fold.begin(), fold.end()) + 1, 0.0);
  for (std::size_t i = 0; i < fold.size(); ++i)
    square[fold[i]] += added.row(static_cast<Eigen::Index>(i)).squaredNorm();
  const double all = added.squaredNorm();
  return all > 0.0 ? *std::max_element(square.begin(), square.end()) / all : 0.0;
}

double gain_of_many(const LinearisedFit& linearised, const Eigen::MatrixXd& columns, const Noise& noise) {
  const Whitening whitening = whitening_of(linearised, noise);
  const Freed model = freed_of(linearised, whitening);
  const Eigen::MatrixXd added = orthonormal(freed(whitened(whitening, columns), model.basis));
  const Eigen::VectorXd gains = added.transpose() * model.residual;
  return has_heavy_tails(model.residual - added * gains) ? (added.transpose() * clipped(model.residual)).squaredNorm()
                                                         : gains.squaredNorm();
}

}  // namespace ballbar
