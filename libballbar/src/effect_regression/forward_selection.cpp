#include "effect_regression/forward_selection.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "ballbar/numerics/parallel.hpp"
#include "effect_regression/ridge.hpp"

namespace ballbar {
namespace {

constexpr std::array<SelectionState, 16> kStates{{{600.0, 0.3},
                                                  {600.0, 1.0},
                                                  {600.0, 3.0},
                                                  {600.0, 10.0},
                                                  {1800.0, 0.3},
                                                  {1800.0, 1.0},
                                                  {1800.0, 3.0},
                                                  {1800.0, 10.0},
                                                  {7200.0, 0.3},
                                                  {7200.0, 1.0},
                                                  {7200.0, 3.0},
                                                  {7200.0, 10.0},
                                                  {30'000.0, 0.3},
                                                  {30'000.0, 1.0},
                                                  {30'000.0, 3.0},
                                                  {30'000.0, 10.0}}};

// Whitened by one discrepancy.
struct Whitened {
  Eigen::MatrixXd fixed, columns;  // not freed of F
  Eigen::MatrixXd free_columns;
  Eigen::VectorXd target, free_target;
  double half_log_det = 0.0;    // of N
  Eigen::VectorXd towards_end;  // covariance of the discrepancy in the last row with all rows, whitened
};

Whitened whitened(const SelectionProblem& problem, double length_s) {
  const Eigen::LLT<Eigen::MatrixXd> root(discrepancy_of(problem.time_s, problem.run, length_s));
  Whitened of;
  of.half_log_det = root.matrixLLT().diagonal().array().log().sum();
  of.fixed = root.matrixL().solve(problem.fixed);
  of.columns = root.matrixL().solve(problem.columns);
  of.target = root.matrixL().solve(problem.target_um);
  Eigen::VectorXd end(problem.target_um.size());
  for (Eigen::Index i = 0; i < end.size(); ++i) {
    const auto row = static_cast<std::size_t>(i);
    const bool same = problem.run[row] == problem.run.back();
    end[i] = same ? remembered(problem.end_s - problem.time_s[row], length_s) : 0.0;
  }
  of.towards_end = root.matrixL().solve(end);
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> basis(of.fixed);
  const Eigen::MatrixXd q = basis.householderQ() * Eigen::MatrixXd::Identity(of.fixed.rows(), basis.rank());
  const auto freed = [&](const auto& of_what) { return (of_what - q * (q.transpose() * of_what)).eval(); };
  of.free_columns = freed(of.columns);
  of.free_target = freed(of.target);
  return of;
}

// q, d of some columns.
struct Scores {
  Eigen::VectorXd q, d;

  Scores(const Eigen::MatrixXd& columns, const Eigen::VectorXd& target)
      : q(columns.transpose() * target), d(columns.colwise().squaredNorm().transpose()) {}

  Eigen::VectorXd rises(double variance, double sum, double degrees) const {
    const Eigen::ArrayXd share = 1.0 + variance * d.array();
    const Eigen::ArrayXd left = (1.0 - variance * q.array().square() / (share * sum)).max(1e-300);
    return -0.5 * degrees * left.log() - 0.5 * share.log();
  }

  void update(const Eigen::VectorXd& along, double factor, double q_of_joined) {
    q -= factor * q_of_joined * along;
    d = (d.array() - factor * along.array().square()).max(0.0);
  }
};

// A state as predictors join.
class Carried {
 public:
  Carried(const Whitened& of, double variance)
      : of_(of),
        variance_(variance),
        columns_(of.free_columns, of.free_target),
        sum_(of.free_target.squaredNorm()),
        degrees_(static_cast<double>(of.fixed.rows() - of.fixed.cols())) {}

  Eigen::VectorXd rises() const { return columns_.rises(variance_, sum_, degrees_); }

  void join(Eigen::Index c) {
    Eigen::VectorXd w = of_.free_columns.col(c);
    for (const auto& [other, factor] : joined_) w -= factor * other.dot(of_.free_columns.col(c)) * other;
    const Eigen::VectorXd along = of_.free_columns.transpose() * w;
    const double factor = variance_ / (1.0 + variance_ * along[c]), q = columns_.q[c];
    sum_ = std::max(sum_ - factor * q * q, std::numeric_limits<double>::min());
    columns_.update(along, factor, q);
    joined_.emplace_back(std::move(w), factor);
  }

  // Gains of F and of these columns, not scaled back.
  Eigen::VectorXd gains(const std::vector<Eigen::Index>& order) const {
    const Eigen::MatrixXd all = together(order);
    Eigen::MatrixXd normal = all.transpose() * all;
    normal.diagonal().tail(all.cols() - of_.fixed.cols()).array() += 1.0 / variance_;
    return normal.ldlt().solve(all.transpose() * of_.target);
  }

  double end_um(const std::vector<Eigen::Index>& order, const Eigen::VectorXd& gains) const {
    return of_.towards_end.dot(of_.target - together(order) * gains);
  }

  // Of the gains, then of what the discrepancy is in the last row: its change with them, and what is not known of it.
  Eigen::MatrixXd covariance_um2(const std::vector<Eigen::Index>& order, double remembered_share) const {
    const Eigen::MatrixXd all = together(order);
    const Eigen::Index p = all.cols();
    Eigen::MatrixXd normal = all.transpose() * all;
    normal.diagonal().tail(p - of_.fixed.cols()).array() += 1.0 / variance_;
    Eigen::MatrixXd change = Eigen::MatrixXd::Identity(p + 1, p);
    change.row(p) = -of_.towards_end.transpose() * all;
    Eigen::MatrixXd covariance = change * normal.ldlt().solve(change.transpose());
    covariance(p, p) += std::max(0.0, remembered_share - of_.towards_end.squaredNorm());
    return covariance * (sum_ / degrees_);
  }

  double log_likelihood() const {
    const double half_log_q = 0.5 * (of_.fixed.transpose() * of_.fixed).ldlt().vectorD().array().log().sum();
    return -0.5 * degrees_ * std::log(sum_ / degrees_) - of_.half_log_det - half_log_q;
  }

  double sigma_um() const { return std::sqrt(sum_ / degrees_); }

 private:
  Eigen::MatrixXd together(const std::vector<Eigen::Index>& order) const {
    Eigen::MatrixXd all(of_.fixed.rows(), of_.fixed.cols() + static_cast<Eigen::Index>(order.size()));
    all.leftCols(of_.fixed.cols()) = of_.fixed;
    for (std::size_t k = 0; k < order.size(); ++k)
      all.col(of_.fixed.cols() + static_cast<Eigen::Index>(k)) = of_.columns.col(order[k]);
    return all;
  }

  const Whitened& of_;
  double variance_;
  Scores columns_;
  double sum_, degrees_;
  std::vector<std::pair<Eigen::VectorXd, double>> joined_;
};

// 1 / (1 + mean exp), without overflow.
double p_none(const Eigen::VectorXd& rises, std::size_t candidates) {
  const double most = std::max(0.0, rises.maxCoeff());
  const double sum = (rises.array() - most).exp().sum() / static_cast<double>(candidates);
  return 1.0 / (1.0 + sum * std::exp(most));
}

}  // namespace

std::span<const SelectionState> all_selection_states() { return kStates; }

PredictorSelection forward_selection(const SelectionProblem& problem, std::span<const SelectionState> states,
                                     std::size_t most) {
  std::vector<double> lengths_s;
  for (const SelectionState& state : states) {
    if (std::find(lengths_s.begin(), lengths_s.end(), state.length_s) == lengths_s.end())
      lengths_s.push_back(state.length_s);
  }
  std::vector<Whitened> whitened_by(lengths_s.size());
  in_parallel(lengths_s.size(), [&](std::size_t i) { whitened_by[i] = whitened(problem, lengths_s[i]); });
  std::vector<Carried> carried;
  carried.reserve(states.size());
  for (const SelectionState& state : states) {
    const auto at = std::find(lengths_s.begin(), lengths_s.end(), state.length_s) - lengths_s.begin();
    carried.emplace_back(whitened_by[static_cast<std::size_t>(at)], state.variance);
  }
  const double share = 1.0 / static_cast<double>(states.size());
  const Eigen::Index p = problem.columns.cols();
  const auto mean_of = [&](auto rises) {
    Eigen::VectorXd mean = Eigen::VectorXd::Zero(p);
    for (const Carried& one : carried) mean += share * rises(one);
    return mean;
  };
  PredictorSelection selection;
  std::vector<Eigen::Index> order;
  const auto fit = [&] {
    SelectedFit result;
    const Eigen::Index count = problem.fixed.cols() + static_cast<Eigen::Index>(order.size());
    result.gains = Eigen::VectorXd::Zero(count);
    for (const Carried& one : carried) {
      const Eigen::VectorXd gains = one.gains(order);
      result.gains += share * gains;
      result.end_um += share * one.end_um(order, gains);
      result.sigma_um += share * one.sigma_um();
    }
    result.covariance_um2 = carried.front().covariance_um2(order, remembered(0.0, states.front().length_s));
    return result;
  };
  selection.log_likelihood = carried.front().log_likelihood();
  selection.fits.push_back(fit());
  while (order.size() < most && static_cast<Eigen::Index>(order.size()) < p) {
    Eigen::VectorXd rises = mean_of([](const Carried& one) { return one.rises(); });
    for (const Eigen::Index c : order) rises[c] = -std::numeric_limits<double>::infinity();
    Selected next;
    Eigen::Index best = 0;
    next.log_bayes = rises.maxCoeff(&best);
    next.column = static_cast<std::size_t>(best);
    next.p_none = p_none(rises, static_cast<std::size_t>(p) - order.size());
    for (Carried& one : carried) one.join(best);
    order.push_back(best);
    selection.joined.push_back(next);
    selection.fits.push_back(fit());
  }
  return selection;
}

}  // namespace ballbar
