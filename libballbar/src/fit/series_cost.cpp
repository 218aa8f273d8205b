#include "fit/series_cost.hpp"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "numerics/least_squares.hpp"

namespace ballbar {
namespace {

constexpr Eigen::Index kBlockRows = 256;
constexpr double kRounding = 1e-12;

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
    const auto count = static_cast<int>(free_.size());
    set_num_residuals(count + 1);
    mutable_parameter_block_sizes()->push_back(count);
    for (const Eigen::Index k : free_) {
      if (k == 0) {
        sources_.push_back({});
        continue;
      }
      std::size_t term = rows_.terms() - 1;
      while (rows_.offset(term) > k) --term;
      sources_.push_back(
          {term, static_cast<std::size_t>(k - rows_.offset(term)), rows_.effect(term).parameters.size()});
    }
  }

  std::vector<double> unknowns_of(const Eigen::VectorXd& p) const {
    std::vector<double> u;
    for (const Eigen::Index k : free_) u.push_back(by_logarithm(bounds_, k) ? std::log(p[k]) : p[k]);
    return u;
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
    const bool with_jacobian = jacobians != nullptr && jacobians[0] != nullptr;
    const auto count = static_cast<Eigen::Index>(free_.size());
    const Eigen::MatrixXd gram = gram_at(parameters_of(blocks[0]), with_jacobian ? count : 0);
    Eigen::Map<Eigen::VectorXd> f(residuals, count + 1);
    if (!gram.allFinite()) return false;
    if (!with_jacobian) {
      f.setZero();
      f[count] = std::sqrt(gram(0, 0));
      return true;
    }
    const Eigen::MatrixXd factor = least_squares::triangular_factor<Eigen::Dynamic>(gram);
    f = factor.col(count);
    Eigen::Map<RowMajor>(jacobians[0], count + 1, count) = factor.leftCols(count);
    return true;
  }

 private:
  // The source of the derivative of a free parameter; the constant has none.
  struct Source {
    std::size_t term = 0, parameter = 0, parameters = 0;
  };

  // Upper half of the Gram matrix of [J r], the first `columns` free parameters in J.
  Eigen::MatrixXd gram_at(const Eigen::VectorXd& p, Eigen::Index columns) const {
    rows_.evaluate(p, columns > 0, evaluated_);
    const Eigen::Index n = target_.size();
    Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(columns + 1, columns + 1);
    RowMajorMatrix state = RowMajorMatrix::Zero(3, columns + 1);
    const RowMajorMatrix& open = weighting_.open.white;
    Eigen::MatrixXd with_open = Eigen::MatrixXd::Zero(open.cols(), columns + 1);
    block_.resize(std::min(kBlockRows, n), columns + 1);
    for (Eigen::Index first = 0; first < n; first += kBlockRows) {
      const Eigen::Index rows = std::min(kBlockRows, n - first);
      auto block = block_.topRows(rows);
      for (Eigen::Index j = 0; j < columns; ++j) fill(first, j, p, block);
      block.col(columns) = target_.segment(first, rows) - evaluated_.sum.segment(first, rows);
      block.array().colwise() *= weighting_.row.segment(first, rows).array();
      if (weighting_.whitening) weighting_.whitening->apply(static_cast<std::size_t>(first), block, state);
      if (weighting_.discount.size() > 0) {
        block.array().colwise() *= weighting_.discount.segment(first, rows).array();
      }
      gram.selfadjointView<Eigen::Upper>().rankUpdate(block.transpose());
      if (open.cols() > 0) with_open.noalias() += open.middleRows(first, rows).transpose() * block;
    }
    if (open.cols() == 0) return gram;
    weighting_.open.factor.matrixL().solveInPlace(with_open);
    gram.selfadjointView<Eigen::Upper>().rankUpdate(with_open.transpose(), -1.0);
    return gram;
  }

  // Derivative of the residual by u_j.
  template <class Block>
  void fill(Eigen::Index first, Eigen::Index j, const Eigen::VectorXd& p, Block& block) const {
    const Eigen::Index k = free_[static_cast<std::size_t>(j)];
    const double factor = by_logarithm(bounds_, k) ? -p[k] : -1.0;
    const Source& source = sources_[static_cast<std::size_t>(j)];
    if (source.parameters == 0) {
      block.col(j).setConstant(factor);
      return;
    }
    const std::vector<double>& slopes = evaluated_.slopes[source.term];
    for (Eigen::Index i = 0; i < block.rows(); ++i) {
      const std::size_t row = rows_.data_rows()[static_cast<std::size_t>(first + i)];
      block(i, j) = factor * slopes[row * source.parameters + source.parameter];
    }
  }

  const ModelRows& rows_;
  const Eigen::VectorXd& target_;
  const Weighting& weighting_;
  const Bounds& bounds_;
  Eigen::VectorXd start_;
  std::vector<Eigen::Index> free_;
  std::vector<Source> sources_;  // as free_
  mutable ModelRows::Evaluated evaluated_;
  mutable RowMajor block_;
};

}  // namespace

OpenColumns::OpenColumns(RowMajorMatrix columns, double variance) : white(std::move(columns)) {
  Eigen::MatrixXd normal = white.transpose() * white;
  normal.diagonal().array() += variance;
  factor.compute(normal);
}

Eigen::VectorXd weighted(const Weighting& weighting, const Eigen::VectorXd& residual) {
  Eigen::VectorXd out = residual.cwiseProduct(weighting.row);
  if (weighting.whitening) {
    const Eigen::VectorXd in = out;
    weighting.whitening->apply(in.data(), 1, out.data(), 1);
  }
  if (weighting.discount.size() > 0) out.array() *= weighting.discount.array();
  return out;
}

Eigen::MatrixXd weighted(const Weighting& weighting, const Eigen::MatrixXd& jacobian) {
  Eigen::MatrixXd out(jacobian.rows(), jacobian.cols());
  for (Eigen::Index k = 0; k < jacobian.cols(); ++k) out.col(k) = weighted(weighting, Eigen::VectorXd(jacobian.col(k)));
  return out;
}

namespace {

struct Search {
  const ModelRows& rows;
  const Eigen::VectorXd& target_um;
  const Weighting& weighting;
  const Bounds& bounds;

  SeriesCost cost(const Eigen::VectorXd& start, const std::vector<Eigen::Index>& free) const {
    return {rows, target_um, weighting, bounds, start, free};
  }

  // exp(log(bound)) equals the bound up to rounding.
  bool at_lower(const Eigen::VectorXd& p, Eigen::Index k) const {
    return p[k] <= bounds.lower[k] + kRounding * std::abs(bounds.lower[k]);
  }
  bool at_upper(const Eigen::VectorXd& p, Eigen::Index k) const {
    return p[k] >= bounds.upper[k] - kRounding * std::abs(bounds.upper[k]);
  }

  // Free parameters, except those on a bound with the gradient pointing outwards.
  std::vector<Eigen::Index> movable(const Eigen::VectorXd& p, const std::vector<Eigen::Index>& free) const {
    const auto on_bound = [&](Eigen::Index k) { return at_lower(p, k) || at_upper(p, k); };
    if (std::none_of(free.begin(), free.end(), on_bound)) return free;
    const SeriesCost at = cost(p, free);
    const auto count = static_cast<Eigen::Index>(free.size());
    Eigen::VectorXd f(count + 1);
    RowMajor jacobian(count + 1, count);
    const std::vector<double> u = at.unknowns_of(p);
    const double* blocks[] = {u.data()};
    double* jacobians[] = {jacobian.data()};
    if (!at.Evaluate(blocks, f.data(), jacobians)) return free;
    const Eigen::VectorXd gradient = jacobian.transpose() * f;
    std::vector<Eigen::Index> result;
    for (Eigen::Index j = 0; j < count; ++j) {
      const Eigen::Index k = free[static_cast<std::size_t>(j)];
      const bool out = (at_lower(p, k) && gradient[j] >= 0.0) || (at_upper(p, k) && gradient[j] <= 0.0);
      if (!out) result.push_back(k);
    }
    return result;
  }
};

// Ends a search where an unknown meets a bound.
class StopAtBound : public ceres::IterationCallback {
 public:
  StopAtBound(const std::vector<double>& u, const std::vector<double>& lower, const std::vector<double>& upper)
      : u_(u), lower_(lower), upper_(upper), before_(u) {}

  ceres::CallbackReturnType operator()(const ceres::IterationSummary&) override {
    for (std::size_t j = 0; j < u_.size(); ++j) {
      const bool met = u_[j] <= lower_[j] || u_[j] >= upper_[j];
      if (met && u_[j] != before_[j]) return ceres::SOLVER_TERMINATE_SUCCESSFULLY;
    }
    before_ = u_;
    return ceres::SOLVER_CONTINUE;
  }

 private:
  const std::vector<double>&u_, &lower_, &upper_;
  std::vector<double> before_;
};

struct Pass {
  Minimum minimum;
  bool met_bound = false;
  int iterations = 0;
};

Pass pass_of(const Search& search, const Eigen::VectorXd& start, const std::vector<Eigen::Index>& free, Stop stop) {
  SeriesCost cost = search.cost(start, free);
  std::vector<double> u = cost.unknowns_of(start);
  const std::vector<double> lower = cost.unknowns_of(search.bounds.lower),
                            upper = cost.unknowns_of(search.bounds.upper);
  ceres::Problem::Options ownership;
  ownership.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(ownership);
  problem.AddResidualBlock(&cost, nullptr, u.data());
  for (std::size_t j = 0; j < u.size(); ++j) {
    if (std::isfinite(lower[j])) problem.SetParameterLowerBound(u.data(), static_cast<int>(j), lower[j]);
    if (std::isfinite(upper[j])) problem.SetParameterUpperBound(u.data(), static_cast<int>(j), upper[j]);
  }
  StopAtBound until_bound(u, lower, upper);
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = stop.most_iterations;
  // Ceres would search along every projected step, for four times as many Jacobians; bounds are dealt with here.
  options.max_num_line_search_step_size_iterations = 0;
  options.function_tolerance = stop.tolerance;
  options.parameter_tolerance = stop.tolerance;
  options.logging_type = ceres::SILENT;
  options.update_state_every_iteration = true;
  options.callbacks.push_back(&until_bound);
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  Pass pass;
  pass.minimum.parameters = cost.parameters_of(u.data());
  // A start where the model is not finite is not a minimum, whatever Ceres returns.
  const bool usable = summary.IsSolutionUsable() && std::isfinite(summary.final_cost) && summary.final_cost >= 0.0;
  pass.minimum.cost = usable ? summary.final_cost : std::numeric_limits<double>::infinity();
  pass.minimum.converged = summary.termination_type == ceres::CONVERGENCE;
  pass.met_bound = summary.termination_type == ceres::USER_SUCCESS;
  pass.iterations = std::max(1, static_cast<int>(summary.iterations.size()) - 1);
  return pass;
}

}  // namespace

// A projected step is poor for the parameters that are not on a bound, because the others did not move as assumed. A
// parameter that meets a bound is therefore held there while the others continue. In the end it is released if the
// gradient points inwards.
Minimum minimise(const ModelRows& rows, const Eigen::VectorXd& target_um, const Weighting& weighting,
                 const Bounds& bounds, const Eigen::VectorXd& start, Stop stop) {
  std::vector<Eigen::Index> free;
  for (Eigen::Index k = 0; k < start.size(); ++k) {
    if (!bounds.held[static_cast<std::size_t>(k)]) free.push_back(k);
  }
  const Search search{rows, target_um, weighting, bounds};
  Minimum minimum{start, 0.0, true};
  std::vector<Eigen::Index> moving = search.movable(start, free);
  if (moving.empty()) {
    minimum.cost = 0.5 * weighted(weighting, Eigen::VectorXd(target_um - rows.sum(start, nullptr))).squaredNorm();
    return minimum;
  }
  while (stop.most_iterations > 0) {
    Pass pass = pass_of(search, minimum.parameters, moving, stop);
    stop.most_iterations -= pass.iterations;
    minimum = std::move(pass.minimum);
    if (std::isinf(minimum.cost)) return minimum;
    std::vector<Eigen::Index> next = search.movable(minimum.parameters, free);
    if (next.empty()) minimum.converged = true;
    if (next.empty() || (!pass.met_bound && next == moving)) break;
    moving = std::move(next);
  }
  return minimum;
}

}  // namespace ballbar
