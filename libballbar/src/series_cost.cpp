#include "series_cost.hpp"

#include <ceres/ceres.h>

#include <cmath>
#include <limits>

namespace ballbar {
namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

bool by_logarithm(const Bounds& bounds, Eigen::Index k) {
  return bounds.lower[k] > 0.0 && bounds.upper[k] > 100.0 * bounds.lower[k];
}

// Free parameters in one block: u = p, or u = log p.
class SeriesCost : public ceres::CostFunction {
 public:
  SeriesCost(const ModelRows& rows, const Eigen::VectorXd& target_um, const Weighting& weighting, const Bounds& bounds,
             Eigen::VectorXd start, std::vector<Eigen::Index> free)
      : rows_(rows),
        target_(target_um),
        weighting_(weighting),
        bounds_(bounds),
        start_(std::move(start)),
        free_(std::move(free)) {
    set_num_residuals(static_cast<int>(target_um.size()));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(free_.size()));
  }

  Eigen::VectorXd parameters_of(const double* u) const {
    Eigen::VectorXd p = start_;
    for (std::size_t j = 0; j < free_.size(); ++j) {
      const Eigen::Index k = free_[j];
      p[k] = by_logarithm(bounds_, k) ? std::exp(u[j]) : u[j];
    }
    return p;
  }

  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override {
    const bool wanted = jacobians != nullptr && jacobians[0] != nullptr;
    const Eigen::VectorXd p = parameters_of(blocks[0]);
    Eigen::MatrixXd derivatives;
    const Eigen::VectorXd model = rows_.sum(p, wanted ? &derivatives : nullptr);
    Eigen::Map<Eigen::VectorXd> out(residuals, num_residuals());
    out = weighted(weighting_, Eigen::VectorXd(target_ - model));
    if (!out.allFinite()) return false;
    if (!wanted) return true;
    Eigen::MatrixXd part(target_.size(), static_cast<Eigen::Index>(free_.size()));
    for (std::size_t j = 0; j < free_.size(); ++j) {
      const Eigen::Index k = free_[j];
      part.col(static_cast<Eigen::Index>(j)) = derivatives.col(k) * (by_logarithm(bounds_, k) ? -p[k] : -1.0);
    }
    Eigen::Map<RowMajor> slope(jacobians[0], num_residuals(), static_cast<Eigen::Index>(free_.size()));
    slope = weighted(weighting_, part);
    return slope.allFinite();
  }

 private:
  const ModelRows& rows_;
  const Eigen::VectorXd& target_;
  const Weighting& weighting_;
  const Bounds& bounds_;
  Eigen::VectorXd start_;
  std::vector<Eigen::Index> free_;
};

}  // namespace

Eigen::VectorXd weighted(const Weighting& weighting, const Eigen::VectorXd& residual) {
  Eigen::VectorXd out = residual.cwiseProduct(weighting.row);
  if (weighting.whitening) {
    const Eigen::VectorXd in = out;
    weighting.whitening->apply(in.data(), 1, out.data(), 1);
  }
  return out;
}

Eigen::MatrixXd weighted(const Weighting& weighting, const Eigen::MatrixXd& jacobian) {
  Eigen::MatrixXd out(jacobian.rows(), jacobian.cols());
  for (Eigen::Index k = 0; k < jacobian.cols(); ++k) out.col(k) = weighted(weighting, Eigen::VectorXd(jacobian.col(k)));
  return out;
}

Minimum minimise(const ModelRows& rows, const Eigen::VectorXd& target_um, const Weighting& weighting,
                 const Bounds& bounds, const Eigen::VectorXd& start, int most_iterations) {
  std::vector<Eigen::Index> free;
  for (Eigen::Index k = 0; k < start.size(); ++k) {
    if (!bounds.held[static_cast<std::size_t>(k)]) free.push_back(k);
  }
  Minimum minimum{start, 0.0, true};
  if (free.empty()) {
    minimum.cost = 0.5 * weighted(weighting, Eigen::VectorXd(target_um - rows.sum(start, nullptr))).squaredNorm();
    return minimum;
  }
  SeriesCost cost(rows, target_um, weighting, bounds, start, free);
  std::vector<double> u;
  u.reserve(free.size());
  for (const Eigen::Index k : free) u.push_back(by_logarithm(bounds, k) ? std::log(start[k]) : start[k]);
  ceres::Problem::Options ownership;
  ownership.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(ownership);
  problem.AddResidualBlock(&cost, nullptr, u.data());
  for (std::size_t j = 0; j < free.size(); ++j) {
    const Eigen::Index k = free[j];
    const bool log = by_logarithm(bounds, k);
    if (std::isfinite(bounds.lower[k])) {
      problem.SetParameterLowerBound(u.data(), static_cast<int>(j), log ? std::log(bounds.lower[k]) : bounds.lower[k]);
    }
    if (std::isfinite(bounds.upper[k])) {
      problem.SetParameterUpperBound(u.data(), static_cast<int>(j), log ? std::log(bounds.upper[k]) : bounds.upper[k]);
    }
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  options.max_num_iterations = most_iterations;
  options.function_tolerance = 1e-10;
  options.parameter_tolerance = 1e-10;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  minimum.parameters = cost.parameters_of(u.data());
  // A start where the model is not finite is no minimum, whatever Ceres leaves there.
  const bool usable = summary.IsSolutionUsable() && std::isfinite(summary.final_cost) && summary.final_cost >= 0.0;
  minimum.cost = usable ? summary.final_cost : std::numeric_limits<double>::infinity();
  minimum.converged = summary.termination_type == ceres::CONVERGENCE;
  return minimum;
}

}  // namespace ballbar
