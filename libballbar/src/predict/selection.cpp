// Predictors chosen one by one, the gains of all of them together.
//
//   y = a + sum_j b_j x_j + e,   b_j ~ N(0, s^2 v),   e ~ N(0, s^2 N),   a free      (N: ridge.hpp)
//
// A predictor j that joins raises the restricted likelihood by
//
//   -(n-1)/2 ln(1 - v q_j^2 / ((1 + v d_j) S)) - 1/2 ln(1 + v d_j),   q_j = z_j'P r,  d_j = z_j'P z_j,  S = r'P r
//
// z_j and r whitened and freed of a, P = I - sum w w' v / (1 + v g) over those that have joined (w = P z, g = z'w). The
// predictor with the largest rise joins, until no more is needed:
//
//   P(none) = 1 / (1 + mean over the predictors of exp of that rise) > 0.5
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "ballbar/internal/numerics/parallel.hpp"
#include "predict/ridge.hpp"

namespace ballbar {
namespace {

constexpr double kNotNeeded = 0.5;         // P(none)
constexpr std::size_t kMostSelected = 12;  // of a selection
constexpr double kSelectionLengths_s[] = {0.0, 1800.0, 7200.0, 30'000.0}, kSelectionVariances[] = {1.0, 3.0, 10.0};

// Whitened by one discrepancy.
struct WhitenedColumns {
  double length_s = 0.0;
  Eigen::MatrixXd fixed, columns;  // not freed of F
  Eigen::MatrixXd free_columns;
  Eigen::VectorXd target, free_target;
  double half_log_det = 0.0;    // of N
  Eigen::VectorXd towards_end;  // covariance of the discrepancy in the last row with all rows, whitened
};

// columns: those of the problem that move.
WhitenedColumns whitened(const RidgeProblem& problem, const Eigen::MatrixXd& columns, double length_s) {
  const Eigen::LLT<Eigen::MatrixXd> root(discrepancy_of(problem.time_s, problem.run, length_s));
  WhitenedColumns of;
  of.length_s = length_s;
  of.half_log_det = root.matrixLLT().diagonal().array().log().sum();
  of.fixed = root.matrixL().solve(Eigen::MatrixXd::Ones(columns.rows(), 1));
  of.columns = root.matrixL().solve(columns);
  of.target = root.matrixL().solve(problem.target_um);
  of.towards_end = root.matrixL().solve(discrepancy_at_end(problem, length_s));
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

// 1 / (1 + mean exp), without overflow.
double p_none(const Eigen::VectorXd& rises, std::size_t candidates) {
  const double most = std::max(0.0, rises.maxCoeff());
  const double sum = (rises.array() - most).exp().sum() / static_cast<double>(candidates);
  return 1.0 / (1.0 + sum * std::exp(most));
}

// The predictors that have joined when no more is needed.
class Selection {
 public:
  Selection(const WhitenedColumns& of, double variance)
      : of_(of),
        variance_(variance),
        columns_(of.free_columns, of.free_target),
        sum_(of.free_target.squaredNorm()),
        degrees_(static_cast<double>(of.fixed.rows() - of.fixed.cols())) {
    const double half_log_q = 0.5 * (of_.fixed.transpose() * of_.fixed).ldlt().vectorD().array().log().sum();
    log_likelihood_ = -0.5 * degrees_ * std::log(sum_ / degrees_) - of_.half_log_det - half_log_q;
    const auto p = static_cast<std::size_t>(of.columns.cols());
    while (order_.size() < std::min(kMostSelected, p)) {
      Eigen::VectorXd rises = columns_.rises(variance_, sum_, degrees_);
      for (const Eigen::Index c : order_) rises[c] = -std::numeric_limits<double>::infinity();
      if (p_none(rises, p - order_.size()) > kNotNeeded) return;
      Eigen::Index best = 0;
      log_likelihood_ += rises.maxCoeff(&best);
      join(best);
    }
  }

  const std::vector<Eigen::Index>& order() const { return order_; }
  double length_s() const { return of_.length_s; }
  double log_likelihood() const { return log_likelihood_; }
  double sigma_um() const { return std::sqrt(sum_ / degrees_); }

  // Of the constant, of those that have joined in their order, and what the discrepancy is in the last row.
  Eigen::VectorXd gains_um() const {
    const Eigen::MatrixXd all = together();
    Eigen::VectorXd gains(all.cols() + 1);
    gains.head(all.cols()) = normal(all).ldlt().solve(all.transpose() * of_.target);
    gains[all.cols()] = of_.towards_end.dot(of_.target - all * gains.head(all.cols()));
    return gains;
  }

  // Of these; the last one: its change with the gains, and what is not known of it.
  Eigen::MatrixXd covariance_um2() const {
    const Eigen::MatrixXd all = together();
    const Eigen::Index p = all.cols();
    Eigen::MatrixXd change = Eigen::MatrixXd::Identity(p + 1, p);
    change.row(p) = -of_.towards_end.transpose() * all;
    Eigen::MatrixXd covariance = change * normal(all).ldlt().solve(change.transpose());
    covariance(p, p) += std::max(0.0, remembered(0.0, of_.length_s) - of_.towards_end.squaredNorm());
    return covariance * (sum_ / degrees_);
  }

 private:
  void join(Eigen::Index c) {
    Eigen::VectorXd w = of_.free_columns.col(c);
    for (const auto& [other, factor] : joined_) w -= factor * other.dot(of_.free_columns.col(c)) * other;
    const Eigen::VectorXd along = of_.free_columns.transpose() * w;
    const double factor = variance_ / (1.0 + variance_ * along[c]), q = columns_.q[c];
    sum_ = std::max(sum_ - factor * q * q, std::numeric_limits<double>::min());
    columns_.update(along, factor, q);
    joined_.emplace_back(std::move(w), factor);
    order_.push_back(c);
  }

  Eigen::MatrixXd together() const {
    Eigen::MatrixXd all(of_.fixed.rows(), of_.fixed.cols() + static_cast<Eigen::Index>(order_.size()));
    all.leftCols(of_.fixed.cols()) = of_.fixed;
    for (std::size_t k = 0; k < order_.size(); ++k)
      all.col(of_.fixed.cols() + static_cast<Eigen::Index>(k)) = of_.columns.col(order_[k]);
    return all;
  }

  Eigen::MatrixXd normal(const Eigen::MatrixXd& all) const {
    Eigen::MatrixXd normal = all.transpose() * all;
    normal.diagonal().tail(all.cols() - of_.fixed.cols()).array() += 1.0 / variance_;
    return normal;
  }

  const WhitenedColumns& of_;
  double variance_;
  Scores columns_;
  double sum_, degrees_, log_likelihood_ = 0.0;
  std::vector<Eigen::Index> order_;
  std::vector<std::pair<Eigen::VectorXd, double>> joined_;
};

}  // namespace

RidgeFit few_effects(const RidgeProblem& problem) {
  std::vector<std::size_t> moving;
  for (Eigen::Index k = 0; k < problem.sd.size(); ++k) {
    if (problem.sd[k] > 0.0) moving.push_back(static_cast<std::size_t>(k));
  }
  const Eigen::MatrixXd columns = problem.columns(Eigen::all, moving);
  std::vector<WhitenedColumns> whitened_by(std::size(kSelectionLengths_s));
  in_parallel(whitened_by.size(),
              [&](std::size_t i) { whitened_by[i] = whitened(problem, columns, kSelectionLengths_s[i]); });
  constexpr std::size_t kVariances = std::size(kSelectionVariances);
  std::vector<std::optional<Selection>> all(whitened_by.size() * kVariances);
  in_parallel(all.size(),
              [&](std::size_t i) { all[i].emplace(whitened_by[i / kVariances], kSelectionVariances[i % kVariances]); });
  const Selection& likeliest = **std::max_element(
      all.begin(), all.end(), [](const auto& a, const auto& b) { return a->log_likelihood() < b->log_likelihood(); });
  // What has no memory is no matter of those that have one, and the other way round.
  const bool is_white = likeliest.length_s() == 0.0;
  std::vector<const Selection*> selections;
  for (const std::optional<Selection>& one : all) {
    if ((one->length_s() == 0.0) == is_white) selections.push_back(&*one);
  }
  RidgeFit result;
  const auto place_of = [&](Eigen::Index column) {
    return std::find(result.used.begin(), result.used.end(), moving[static_cast<std::size_t>(column)]);
  };
  for (const Selection* const one : selections) {
    for (const Eigen::Index column : one->order()) {
      if (place_of(column) == result.used.end()) result.used.push_back(moving[static_cast<std::size_t>(column)]);
    }
  }
  const auto m = static_cast<Eigen::Index>(result.used.size());
  const double share = 1.0 / static_cast<double>(selections.size());
  Eigen::MatrixXd gains = Eigen::MatrixXd::Zero(m + 2, static_cast<Eigen::Index>(selections.size()));
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(m + 2, m + 2);
  for (std::size_t s = 0; s < selections.size(); ++s) {
    std::vector<Eigen::Index> place{0};  // of b, its own predictors, the discrepancy
    for (const Eigen::Index column : selections[s]->order())
      place.push_back(place_of(column) - result.used.begin() + 1);
    place.push_back(m + 1);
    gains.col(static_cast<Eigen::Index>(s))(place) = selections[s]->gains_um();
    covariance(place, place) += share * selections[s]->covariance_um2();
  }
  result.setting.length_s = likeliest.length_s();
  result.sigma_um = likeliest.sigma_um();
  result.gains_um = gains.rowwise().mean();
  const Eigen::MatrixXd apart = gains.colwise() - result.gains_um;
  covariance += share * apart * apart.transpose();
  covariance.diagonal().array() += 1e-12 * covariance.diagonal().cwiseAbs().maxCoeff();
  result.factor_um = covariance.llt().matrixL();
  return result;
}

}  // namespace ballbar
