// One Ceres cost over all readings, in constant memory, and the covariance under an autocorrelated residual.
//
// n readings enter a least-squares problem only through the Gram matrix of [J r]: with its triangular
// factor [U q; 0 e],
//   |r|^2 = |q|^2 + e^2,   J'r = U'q,   J'J = U'U.
// So Ceres is handed one cost with P + 1 residuals (q, e) and the Jacobian (U; 0): the same steps and the
// same covariance as n residual blocks would give, without n by P numbers in memory. A Gram matrix squares
// the condition number, so the unknowns are first made orthonormal: p = p0 + B s, B the inverse
// of the triangular factor of J at p0 by Householder QR (of evenly spaced readings, where there are many).
#pragma once

#include <ceres/ceres.h>

#include <Eigen/Core>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "numerics/row_blocks.hpp"

namespace ballbar::least_squares {

// P, the number of parameters, is fixed where it is known when compiling; Eigen::Dynamic does the same, slower.

// Ceres stores matrices by rows; Eigen wants a single column by columns.
template <int R, int C>
using CeresMatrix = Eigen::Matrix<double, R, C, C == 1 ? Eigen::ColMajor : Eigen::RowMajor>;

// Replaces r by the g with g^2 = scale^2 rho(r^2 / scale^2), and its derivatives: the sum of squares of g is
// the robust objective.
template <class Part>
void discount(Part& part, const ceres::LossFunction& loss, double scale) {
  const Eigen::Index last = part.cols() - 1;
  for (Eigen::Index i = 0; i < part.rows(); ++i) {
    const double r = part(i, last) / scale;
    double rho[3];
    loss.Evaluate(r * r, rho);
    const double g = std::sqrt(rho[0]);
    part.row(i).head(last) *= g > 0.0 ? rho[1] * std::abs(r) / g : 1.0;
    part(i, last) = std::copysign(scale * g, r);
  }
}

// Unknowns s of p = origin + basis s.
template <int P>
struct Unknowns {
  Eigen::Vector<double, P> origin;
  Eigen::Matrix<double, P, P> basis;

  Eigen::Vector<double, P> at(const Eigen::Vector<double, P>& s) const { return origin + basis * s; }
};

// Upper triangular U with U'U = gram, for a gram of [J r] (of which the upper half is read); rows of zeros where it is
// singular.
template <int N>
Eigen::Matrix<double, N, N> triangular_factor(const Eigen::Matrix<double, N, N>& gram) {
  const Eigen::Index n = gram.cols();
  Eigen::Matrix<double, N, N> u = Eigen::Matrix<double, N, N>::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double rest = gram(i, i) - u.col(i).head(i).squaredNorm();
    if (rest <= 1e-15 * gram(i, i)) continue;
    u(i, i) = std::sqrt(rest);
    for (Eigen::Index j = i + 1; j < n; ++j) u(i, j) = (gram(i, j) - u.col(i).head(i).dot(u.col(j).head(i))) / u(i, i);
  }
  return u;
}

template <int P, class Rows>
class CondensedCost final : public ceres::CostFunction {
 public:
  CondensedCost(const Rows& rows, const Unknowns<P>& unknowns, const ceres::LossFunction* loss, double scale)
      : rows_(rows), unknowns_(unknowns), size_(unknowns.origin.size()), loss_(loss), scale_(scale) {
    set_num_residuals(static_cast<int>(size_) + 1);
    mutable_parameter_block_sizes()->push_back(static_cast<int>(size_));
  }

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    const Eigen::Map<const Eigen::Vector<double, P>> s(parameters[0], size_);
    const Eigen::Vector<double, P> p = unknowns_.at(s);
    const bool with_jacobian = jacobians != nullptr && jacobians[0] != nullptr;
    if (with_jacobian && s == last_s_) return hand_over(residuals, jacobians[0]);
    Square gram = Square::Zero(size_ + 1, size_ + 1), basis = Square::Identity(size_ + 1, size_ + 1);
    basis.topLeftCorner(size_, size_) = unknowns_.basis;
    double sum_squares = 0.0;
    RowBlock<P> orthonormal(kBlockRows, size_ + 1);
    for_each_block<P>(rows_, p, [&](Eigen::Index, auto& part) {
      if (loss_ != nullptr) discount(part, *loss_, scale_);
      if (!with_jacobian) {
        sum_squares += part.col(size_).squaredNorm();
        return;
      }
      auto block = orthonormal.topRows(part.rows());
      block.noalias() = part.lazyProduct(basis);
      for (Eigen::Index i = 0; i <= size_; ++i) {
        for (Eigen::Index j = i; j <= size_; ++j) gram(i, j) += block.col(i).dot(block.col(j));
      }
    });
    if (!with_jacobian) {
      Eigen::Map<Eigen::Vector<double, kAndOne<P>>> f(residuals, size_ + 1);
      f.setZero();
      f[size_] = std::sqrt(sum_squares);
      return std::isfinite(sum_squares);
    }
    if (!gram.allFinite()) return false;
    last_s_ = s;
    last_factor_ = triangular_factor<kAndOne<P>>(gram);
    return hand_over(residuals, jacobians[0]);
  }

 private:
  using Square = Eigen::Matrix<double, kAndOne<P>, kAndOne<P>>;

  bool hand_over(double* residuals, double* jacobian) const {
    Eigen::Map<Eigen::Vector<double, kAndOne<P>>> f(residuals, size_ + 1);
    Eigen::Map<CeresMatrix<kAndOne<P>, P>> j(jacobian, size_ + 1, size_);
    f = last_factor_.col(size_);
    j = last_factor_.leftCols(size_);
    return true;
  }

  const Rows& rows_;
  const Unknowns<P>& unknowns_;
  Eigen::Index size_;
  const ceres::LossFunction* loss_;
  double scale_;
  // The last Jacobian: the solver, the last steps and the covariance ask for it at the same point.
  mutable Eigen::Vector<double, P> last_s_ =
      Eigen::Vector<double, P>::Constant(unknowns_.origin.size(), std::numeric_limits<double>::quiet_NaN());
  mutable Square last_factor_;
};

template <int P>
struct Solution {
  Eigen::Vector<double, P> p;
  Eigen::Matrix<double, P, P> inverse_information;  // (J'J)^-1 at p; NaN unless determined
  double sum_squares = 0.0;
  bool determined = false;  // J has full rank to working precision
  bool converged = false;
  std::string outcome;
};

inline constexpr Eigen::Index kEnoughReadings = 512;

enum class Basis { scaled, orthonormal };

// Unknowns about p0: each scaled by its column of J, or orthonormal; and whether J has full rank there (scaled
// ones where it has not).
template <int P, class Rows>
Unknowns<P> unknowns_at(const Rows& rows, const Eigen::Vector<double, P>& p0, Basis basis, bool& determined) {
  const EveryNth<Rows> some{rows, (rows.size() + kEnoughReadings - 1) / kEnoughReadings};
  const Eigen::Index size = p0.size();
  Eigen::MatrixXd jacobian(some.size(), size);
  const auto take = [&](Eigen::Index first, const auto& part) {
    jacobian.middleRows(first, part.rows()) = part.leftCols(size);
  };
  some.step == 1 ? for_each_block<P>(rows, p0, take) : for_each_block<P>(some, p0, take);
  const Eigen::Vector<double, P> norm = jacobian.colwise().norm().cwiseMax(1e-300);
  jacobian *= norm.cwiseInverse().asDiagonal();
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(jacobian);
  Unknowns<P> unknowns{p0, norm.cwiseInverse().asDiagonal()};
  const double smallest = jacobian.rows() < size ? 0.0 : std::abs(qr.matrixQR()(size - 1, size - 1));
  determined = smallest > 1e-13 * qr.maxPivot() && norm.minCoeff() > 1e-150 && norm.allFinite();
  if (determined && basis == Basis::orthonormal) {
    const Eigen::Matrix<double, P, P> inverse =
        qr.matrixQR().topRows(size).template triangularView<Eigen::Upper>().solve(
            Eigen::Matrix<double, P, P>::Identity(size, size));
    unknowns.basis = norm.cwiseInverse().asDiagonal() * (qr.colsPermutation() * inverse);
  }
  return unknowns;
}

// Ceres stops where the cost no longer changes in double precision; that leaves the root of that precision in
// the unknowns. Gauss-Newton steps on the gradient take out the rest, as long as they shrink. Whether the residual
// is 0: 1e-6 of what the residual's norm amounts to.
template <int P, class Cost>
bool take_out_the_rest(const Cost& cost, Eigen::Vector<double, P>& s) {
  double last = std::numeric_limits<double>::infinity();
  double size = last;
  double norm = 0.0;
  for (int step = 0; step < 200; ++step) {
    Eigen::Vector<double, kAndOne<P>> f(s.size() + 1);
    CeresMatrix<kAndOne<P>, P> jacobian(s.size() + 1, s.size());
    const double* parameters[] = {s.data()};
    double* jacobians[] = {jacobian.data()};
    if (!cost.Evaluate(parameters, f.data(), jacobians)) return false;
    const Eigen::Vector<double, P> change =
        jacobian.topRows(s.size()).template triangularView<Eigen::Upper>().solve(-f.head(s.size()));
    size = change.norm();
    norm = f.norm();
    if (!(size < 0.99 * last) || size <= 1e-11 * norm) break;
    s += change;
    last = size;
  }
  return size <= 1e-6 * norm;
}

// approach: to somewhere near the solution. settle: to the last digits, with the covariance.
enum class Aim { approach, settle };

// One Ceres problem about p0. `moved` is how far the solution lies from there in multiples of the residual's norm
// (orthonormal unknowns).
template <int P, class Rows>
Solution<P> minimise_once(const Rows& rows, const Eigen::Vector<double, P>& p0, Basis basis, Aim aim,
                          const ceres::LossFunction* loss, double scale, double& moved) {
  Solution<P> solution;
  solution.inverse_information.setConstant(p0.size(), p0.size(), std::numeric_limits<double>::quiet_NaN());
  const Unknowns<P> unknowns = unknowns_at<P>(rows, p0, basis, solution.determined);
  CondensedCost<P, Rows> cost(rows, unknowns, loss, scale);
  ceres::Problem::Options problem_options;
  problem_options.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(problem_options);
  Eigen::Vector<double, P> s = Eigen::Vector<double, P>::Zero(p0.size());
  problem.AddResidualBlock(&cost, nullptr, s.data());

  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.logging_type = ceres::SILENT;
  options.max_num_iterations = 500;
  options.parameter_tolerance = 1e-10;
  options.gradient_tolerance = 0.0;
  const bool settle = solution.determined && aim == Aim::settle;
  ceres::Solver::Summary summary;
  bool settled = false;
  // From a near start the last steps alone are enough, once Ceres has made the first; where not, Ceres goes on.
  for (const double tolerance : {settle ? 1e-2 : 1e-10, 1e-10}) {
    options.function_tolerance = tolerance;
    ceres::Solve(options, &problem, &summary);
    settled = settle && take_out_the_rest<P>(cost, s);
    if (settled || !settle) break;
  }
  solution.p = unknowns.at(s);
  solution.converged = settled || summary.termination_type == ceres::CONVERGENCE;
  solution.outcome = summary.message;
  solution.sum_squares = 2.0 * summary.final_cost;
  moved = s.norm() / std::sqrt(std::max(solution.sum_squares, std::numeric_limits<double>::min()));
  if (!settle) return solution;
  Eigen::Vector<double, kAndOne<P>> f(s.size() + 1);
  CeresMatrix<kAndOne<P>, P> jacobian(s.size() + 1, s.size());
  const double* at[] = {s.data()};
  double* jacobians[] = {jacobian.data()};
  solution.determined = cost.Evaluate(at, f.data(), jacobians);  // Ceres' covariance does not survive a failure
  if (!solution.determined) return solution;
  solution.sum_squares = f.squaredNorm();

  ceres::Covariance::Options covariance_options;
  covariance_options.algorithm_type = ceres::DENSE_SVD;
  covariance_options.null_space_rank = -1;  // a pseudo-inverse instead of a message on the terminal
  ceres::Covariance covariance(covariance_options);
  const std::vector<std::pair<const double*, const double*>> blocks{{s.data(), s.data()}};
  CeresMatrix<P, P> inverse(s.size(), s.size());
  solution.determined = covariance.Compute(blocks, &problem) &&
                        covariance.GetCovarianceBlock(s.data(), s.data(), inverse.data()) &&
                        inverse.diagonal().minCoeff() > 0.0;
  solution.inverse_information = unknowns.basis * inverse * unknowns.basis.transpose();
  return solution;
}

// How good a start is: an algebraic solution, or a guess.
enum class Start { near, far };

// Least squares from `start`; with a loss, robust at that scale (unit of the residual). From afar the way is made in
// scaled unknowns, where Ceres' damping holds back what the readings hardly determine. With many readings evenly
// spaced ones come first. Then in orthonormal unknowns about the solution, until it no longer moves far.
template <int P, class Rows>
Solution<P> minimise(const Rows& rows, const Eigen::Vector<double, P>& start, Start quality,
                     const ceres::LossFunction* loss = nullptr, double scale = 1.0) {
  double moved = 0.0;
  Eigen::Vector<double, P> p = start;
  if (quality == Start::far) p = minimise_once<P>(rows, p, Basis::scaled, Aim::approach, loss, scale, moved).p;
  if (rows.size() > 4 * kEnoughReadings) {
    const EveryNth<Rows> some{rows, rows.size() / kEnoughReadings};
    p = minimise_once<P>(some, p, Basis::orthonormal, Aim::approach, loss, scale, moved).p;
  }
  Solution<P> solution = minimise_once<P>(rows, p, Basis::orthonormal, Aim::settle, loss, scale, moved);
  for (int round = 0; round < 20 && moved > 0.5; ++round) {
    solution = minimise_once<P>(rows, solution.p, Basis::orthonormal, Aim::settle, loss, scale, moved);
  }
  return solution;
}

}  // namespace ballbar::least_squares
