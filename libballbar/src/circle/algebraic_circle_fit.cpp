// The algebraic circle (Al-Sharadqah and Chernov, Electronic Journal of Statistics 3 (2009) 886-911), through
// the triangular factor of the design matrix [z x y 1] in centred and scaled coordinates.
#include <fmt/core.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <cmath>

#include "ballbar/circle/circle.hpp"
#include "ballbar/error.hpp"

namespace ballbar {
namespace {

// The vector A that minimises |R A| under A' N A = 1: the smallest positive generalised eigenvalue of
// (R'R, N). With W = R^-T N R^-1, W v = (1/eta) v, so the largest eigenvalue of W, A = R^-1 v.
Eigen::Vector4d constrained_minimum(const Eigen::Matrix4d& factor, const Eigen::Matrix4d& constraint) {
  const auto upper = factor.triangularView<Eigen::Upper>();
  const Eigen::Matrix4d inverse = upper.solve(Eigen::Matrix4d::Identity());
  const Eigen::Matrix4d whitened = inverse.transpose() * constraint * inverse;
  const Eigen::MatrixXd symmetric = 0.5 * (whitened + whitened.transpose());
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(symmetric);
  return inverse * eigen.eigenvectors().col(3);
}

// Hyper, for mean x = mean y = 0.
Eigen::Matrix4d constraint_of(double mean_z) {
  Eigen::Matrix4d n = Eigen::Matrix4d::Zero();
  n(0, 0) = 8.0 * mean_z;
  n(1, 1) = n(2, 2) = 1.0;
  n(0, 3) = n(3, 0) = 2.0;
  return n;
}

}  // namespace

PlaneCircle algebraic_circle(const Eigen::ArrayXd& x, const Eigen::ArrayXd& y) {
  const Eigen::Index n = x.size();
  if (n < 3 || y.size() != n) {
    throw Error(fmt::format("a circle needs at least 3 points with x and y, found {} x and {} y", n, y.size()));
  }
  const double mean_x = x.mean();
  const double mean_y = y.mean();
  const double scale = std::sqrt(((x - mean_x).square() + (y - mean_y).square()).mean());
  if (!(scale > 0.0) || !std::isfinite(scale))
    throw Error("a circle needs points that are finite and not all the same");

  Eigen::MatrixXd design(n, 4);
  design.col(1) = (x - mean_x) / scale;
  design.col(2) = (y - mean_y) / scale;
  design.col(0) = design.col(1).cwiseAbs2() + design.col(2).cwiseAbs2();
  design.col(3).setOnes();
  const double mean_z = design.col(0).mean();
  Eigen::Matrix4d factor = Eigen::Matrix4d::Zero();
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(design);
  const Eigen::Index rank_rows = std::min<Eigen::Index>(n, 4);
  factor.topRows(rank_rows) = qr.matrixQR().topRows(rank_rows).triangularView<Eigen::Upper>();

  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(factor, Eigen::ComputeFullV);
  const Eigen::VectorXd& singular = svd.singularValues();
  const bool on_a_circle = singular[3] < 1e-13 * singular[0];  // exact: the null vector
  const Eigen::Vector4d abc =
      on_a_circle ? Eigen::Vector4d(svd.matrixV().col(3)) : constrained_minimum(factor, constraint_of(mean_z));
  const double a = abc[0];
  const double spread = abc[1] * abc[1] + abc[2] * abc[2] - 4.0 * a * abc[3];
  if (singular[2] < 1e-10 * singular[0] || std::abs(a) < 1e-12 * abc.norm() || !(spread > 0.0)) {
    throw Error(fmt::format("the {} points lie on one line, no circle goes through them", n));
  }
  PlaneCircle circle;
  circle.centre_x = mean_x - scale * abc[1] / (2.0 * a);
  circle.centre_y = mean_y - scale * abc[2] / (2.0 * a);
  circle.radius = scale * std::sqrt(spread) / (2.0 * std::abs(a));
  circle.rms = std::sqrt(
      (((x - circle.centre_x).square() + (y - circle.centre_y).square()).sqrt() - circle.radius).square().mean());
  return circle;
}

}  // namespace ballbar
