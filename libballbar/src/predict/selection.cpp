#include "predict/selection.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "ballbar/numerics/parallel.hpp"

namespace ballbar {
namespace {

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

// One selection: gains of b and of its own predictors, and the discrepancy in the last row.
struct Variant {
  std::vector<std::size_t> columns;  // of the problem
  SelectedFit fit;
  double log_likelihood = 0.0, length_s = 0.0;
};

}  // namespace

std::vector<RidgeSetting> selection_states(std::span<const double> lengths_s, std::span<const double> variances) {
  std::vector<RidgeSetting> states;
  for (const double length_s : lengths_s) {
    for (const double variance : variances) states.push_back({0, variance, length_s});
  }
  return states;
}

PredictorSelection forward_selection(const SelectionProblem& problem, std::span<const RidgeSetting> states,
                                     std::size_t most) {
  std::vector<double> lengths_s;
  for (const RidgeSetting& state : states) {
    if (std::find(lengths_s.begin(), lengths_s.end(), state.length_s) == lengths_s.end())
      lengths_s.push_back(state.length_s);
  }
  std::vector<Whitened> whitened_by(lengths_s.size());
  in_parallel(lengths_s.size(), [&](std::size_t i) { whitened_by[i] = whitened(problem, lengths_s[i]); });
  std::vector<Carried> carried;
  carried.reserve(states.size());
  for (const RidgeSetting& state : states) {
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

RidgeFit few_effects(const RidgeProblem& problem) {
  std::vector<std::size_t> moving;
  for (Eigen::Index k = 0; k < problem.sd.size(); ++k) {
    if (problem.sd[k] > 0.0) moving.push_back(static_cast<std::size_t>(k));
  }
  SelectionProblem selected;
  selected.fixed = Eigen::MatrixXd::Ones(problem.columns.rows(), 1);
  selected.columns = problem.columns(Eigen::all, moving);
  selected.target_um = problem.target_um;
  selected.time_s = problem.time_s;
  selected.run = problem.run;
  selected.end_s = problem.end_s;
  const std::vector<RidgeSetting> states =
      selection_states(std::array{0.0, 1800.0, 7200.0, 30'000.0}, std::array{1.0, 3.0, 10.0});
  std::vector<Variant> variants(states.size());
  in_parallel(states.size(), [&](std::size_t s) {
    const PredictorSelection selection = forward_selection(selected, {&states[s], 1}, kMostSelected);
    Variant& of = variants[s];
    of.length_s = states[s].length_s;
    of.log_likelihood = selection.log_likelihood;
    while (of.columns.size() < selection.joined.size() && selection.joined[of.columns.size()].p_none <= kNotNeeded) {
      of.log_likelihood += selection.joined[of.columns.size()].log_bayes;
      of.columns.push_back(moving[selection.joined[of.columns.size()].column]);
    }
    of.fit = selection.fits[of.columns.size()];
  });
  const Variant likeliest = *std::max_element(variants.begin(), variants.end(), [](const auto& a, const auto& b) {
    return a.log_likelihood < b.log_likelihood;
  });
  // What has no memory is no matter of those that have one, and the other way round.
  const bool is_white = likeliest.length_s == 0.0;
  std::erase_if(variants, [&](const Variant& of) { return (of.length_s == 0.0) != is_white; });
  RidgeFit result;
  for (const Variant& of : variants) {
    for (const std::size_t column : of.columns) {
      if (std::find(result.used.begin(), result.used.end(), column) == result.used.end()) result.used.push_back(column);
    }
  }
  const auto m = static_cast<Eigen::Index>(result.used.size());
  const double share = 1.0 / static_cast<double>(variants.size());
  Eigen::MatrixXd gains = Eigen::MatrixXd::Zero(m + 2, static_cast<Eigen::Index>(variants.size()));
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(m + 2, m + 2);
  for (std::size_t s = 0; s < variants.size(); ++s) {
    const Variant& of = variants[s];
    std::vector<Eigen::Index> place{0};  // of b, its own predictors, the discrepancy
    for (const std::size_t column : of.columns)
      place.push_back(std::find(result.used.begin(), result.used.end(), column) - result.used.begin() + 1);
    place.push_back(m + 1);
    for (std::size_t i = 0; i < place.size(); ++i) {
      const auto at = static_cast<Eigen::Index>(i);
      gains(place[i], static_cast<Eigen::Index>(s)) = i + 1 < place.size() ? of.fit.gains[at] : of.fit.end_um;
      for (std::size_t j = 0; j < place.size(); ++j)
        covariance(place[i], place[j]) += share * of.fit.covariance_um2(at, static_cast<Eigen::Index>(j));
    }
  }
  result.setting.length_s = likeliest.length_s;
  result.sigma_um = likeliest.fit.sigma_um;
  result.gains_um = gains.rowwise().mean();
  const Eigen::MatrixXd apart = gains.colwise() - result.gains_um;
  covariance += share * apart * apart.transpose();
  covariance.diagonal().array() += 1e-12 * covariance.diagonal().cwiseAbs().maxCoeff();
  result.factor_um = covariance.llt().matrixL();
  return result;
}

}  // namespace ballbar
