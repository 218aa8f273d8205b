#include "diagnosis/verdict/gains_by_run.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>

#include "ballbar/series/runs.hpp"
#include "diagnosis/posterior/hyperparameters.hpp"
#include "diagnosis/posterior/variant.hpp"
#include "diagnosis/thresholds.hpp"
#include "numerics/orthonormal.hpp"
#include "numerics/tails.hpp"

namespace ballbar {
namespace {

// A white column whose coefficient is a gain.
struct GainColumn {
  std::string effect, parameter, unit;
  Eigen::Index column = 0;  // of the line, then of the members
  double scale = 1.0;       // um of the gain for a coefficient of 1
};

std::vector<GainColumn> gain_columns(const Problem& problem, const Posterior& posterior, const EffectSet& set,
                                     const SetRegression& at) {
  std::vector<GainColumn> gains;
  const Variant& variant = posterior.variants[set.variant];
  const BaseColumns base = problem.base_model->at(variant.parameters, free_of(problem, variant.own));
  for (std::size_t k = 0; k < base.columns.size(); ++k) {
    const BaseColumn& column = base.columns[k];
    if (column.kind != BaseColumn::Kind::gain) continue;
    const Term& term = problem.model.terms[problem.base_model->term_of(column.parameter)];
    if (term.effect->rules.of_set_up) continue;
    const Parameter& parameter = problem.base_model->parameter(column.parameter);
    gains.push_back({label_of(term), parameter.name, parameter.unit, static_cast<Eigen::Index>(k), column.scale});
  }
  for (std::size_t m = 0; m < set.signatures.size(); ++m) {
    const Signature& signature = problem.library.signatures[set.signatures[m]];
    const BoundEffect& bound = problem.library.families[signature.family].bound;
    if (at.width[m] != 1) continue;  // one of several gains is not meaningful alone
    for (const Parameter& parameter : bound.effect->parameters) {
      if (parameter.kind != ParameterKind::gain) continue;
      gains.push_back({label_of(bound), parameter.name, parameter.unit, at.white_line.cols() + at.first[m],
                       1.0 / problem.deviation[signature.first]});
    }
  }
  return gains;
}

// The columns with a common gain replacing the separate gains of each run.
Eigen::MatrixXd columns_by_run(const Eigen::MatrixXd& all, const std::vector<Eigen::Index>& gains,
                               const std::vector<RowRange>& runs) {
  const auto count = static_cast<Eigen::Index>(runs.size());
  std::vector<Eigen::Index> kept;
  for (Eigen::Index k = 0; k < all.cols(); ++k) {
    if (std::find(gains.begin(), gains.end(), k) == gains.end()) kept.push_back(k);
  }
  const auto first = static_cast<Eigen::Index>(kept.size());
  Eigen::MatrixXd x = Eigen::MatrixXd::Zero(all.rows(), first + count * static_cast<Eigen::Index>(gains.size()));
  x.leftCols(first) = all(Eigen::all, kept);
  for (std::size_t g = 0; g < gains.size(); ++g) {
    for (Eigen::Index r = 0; r < count; ++r) {
      const RowRange& run = runs[static_cast<std::size_t>(r)];
      const auto begin = static_cast<Eigen::Index>(run.begin), n = static_cast<Eigen::Index>(run.end - run.begin);
      x.col(first + static_cast<Eigen::Index>(g) * count + r).segment(begin, n) = all.col(gains[g]).segment(begin, n);
    }
  }
  return x;
}

// The model with the set, with separate gains in each run.
Variant variant_by_run(const Problem& problem, const Posterior& posterior, const EffectSet& set,
                       const std::vector<Eigen::Index>& gains, const std::vector<RowRange>& runs) {
  const Variant with = with_signatures(problem, posterior.variants[set.variant], set.signatures);
  const Eigen::MatrixXd columns =
      columns_by_run(Eigen::MatrixXd(with.pool(Eigen::all, with.line.columns)), gains, runs);
  Variant by_run = with;
  by_run.line = {};
  for (std::size_t k = 0; k < with.line.is_free.size(); ++k) {
    if (std::find(gains.begin(), gains.end(), static_cast<Eigen::Index>(k)) == gains.end())
      by_run.line.is_free.push_back(with.line.is_free[k]);
  }
  by_run.line.is_free.resize(static_cast<std::size_t>(columns.cols()), 1);
  by_run.pool.resize(columns.rows(), 1 + columns.cols());
  by_run.pool.col(0) = with.pool.col(0);
  by_run.pool.rightCols(columns.cols()) = columns;
  for (Eigen::Index k = 0; k < columns.cols(); ++k) by_run.line.columns.push_back(1 + k);
  return by_run;
}

// The set at its most likely parameters with separate gains in each run, and the scatter of that fit. With a common
// gain the differences would count as noise.
SetRegression set_with_gains_by_run(const Problem& problem, const Posterior& posterior, EffectSet set,
                                    const std::vector<Eigen::Index>& gains, const std::vector<RowRange>& runs) {
  SetRegression best;
  double most = kLogZero;
  set.point = 0;
  std::vector<Point> points = posterior.points;
  const Variant by_run = variant_by_run(problem, posterior, set, gains, runs);
  for (const Discrepancy kind : discrepancies_of(problem))
    points.push_back(point_at(problem, likeliest_covariance(problem, by_run, kind)));
  for (const Point& point : points) {
    Posterior there;
    there.points = {point};
    there.variants = posterior.variants;
    SetRegression at = set_regression(problem, there, set);
    const Eigen::MatrixXd x = columns_by_run(at.white_columns(), gains, runs);
    const double degrees = std::max(1.0, static_cast<double>(at.white_y.size() - x.cols()));
    const double variance = std::max(1e-300, orthogonal_part(at.white_y, orthonormal(x)).squaredNorm() / degrees);
    const double log_p = -0.5 * there.points.front().filter.log_determinant() - 0.5 * degrees * std::log(variance);
    if (!(log_p > most)) continue;
    most = log_p;
    best = std::move(at);
    best.variance = variance;
  }
  return best;
}

}  // namespace

std::vector<GainByRun> gains_by_run(const Problem& problem, const Posterior& posterior, const EffectSet& set,
                                    const SetRegression& found_at) {
  std::vector<GainByRun> differ;
  const std::vector<RowRange> runs = runs_of(problem.time_s);
  if (problem.model.level != Level::series || runs.size() < 2) return differ;
  const std::vector<GainColumn> gains = gain_columns(problem, posterior, set, found_at);
  if (gains.empty()) return differ;
  std::vector<Eigen::Index> columns;
  columns.reserve(gains.size());
  for (const GainColumn& gain : gains) columns.push_back(gain.column);
  const SetRegression at = set_with_gains_by_run(problem, posterior, set, columns, runs);
  const Eigen::MatrixXd all = at.white_columns();
  const auto count = static_cast<Eigen::Index>(runs.size());
  for (const GainColumn& gain : gains) {
    const Eigen::MatrixXd x = columns_by_run(all, {gain.column}, runs);
    const double together = orthogonal_part(at.white_y, orthonormal(all)).squaredNorm();
    const double each = orthogonal_part(at.white_y, orthonormal(x)).squaredNorm();
    const double p = chi2_upper_tail((together - each) / at.variance, runs.size() - 1);
    if (!(p < kSameGain / static_cast<double>(gains.size()))) continue;
    const Eigen::VectorXd scale = x.colwise().norm().cwiseMax(1e-300).cwiseInverse();
    Eigen::MatrixXd gram = scale.asDiagonal() * (x.transpose() * x) * scale.asDiagonal();
    gram.diagonal().array() += 1e-12;
    const Eigen::LLT<Eigen::MatrixXd> factor(gram);
    const Eigen::VectorXd solution =
        scale.asDiagonal() * factor.solve(scale.asDiagonal() * (x.transpose() * at.white_y));
    const Eigen::MatrixXd inverse = factor.solve(Eigen::MatrixXd::Identity(x.cols(), x.cols()));
    GainByRun found{gain.effect, gain.parameter, gain.unit, p, {}, {}};
    for (Eigen::Index r = 0; r < count; ++r) {
      const Eigen::Index k = x.cols() - count + r;
      found.gain.push_back(gain.scale * solution[k]);
      found.sigma.push_back(gain.scale * scale[k] * std::sqrt(at.variance * inverse(k, k)));
    }
    differ.push_back(std::move(found));
  }
  return differ;
}

}  // namespace ballbar
