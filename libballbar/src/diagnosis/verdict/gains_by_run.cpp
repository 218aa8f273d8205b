#include "diagnosis/verdict/gains_by_run.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "ballbar/series/series.hpp"
#include "diagnosis/posterior/hyperparameters.hpp"
#include "diagnosis/posterior/linearisation.hpp"
#include "numerics/tails.hpp"

namespace ballbar {
namespace {

// A column whose coefficient is a gain.
struct GainColumn {
  std::string effect, parameter, unit;
  Eigen::Index column = 0;  // of the model, then of the members
  double scale = 1.0;       // um of the gain for a coefficient of 1
};

std::vector<GainColumn> gain_columns(const Problem& problem, const Posterior& posterior, const EffectSet& set) {
  std::vector<GainColumn> gains;
  const Linearisation& linearisation = posterior.linearisations[set.linearisation];
  const BaseColumns base = problem.base_model->at(linearisation.parameters, free_of(problem, linearisation.freed));
  for (std::size_t k = 0; k < base.columns.size(); ++k) {
    const BaseColumn& column = base.columns[k];
    if (column.kind != BaseColumn::Kind::gain) continue;
    const Term& term = problem.model.terms[problem.base_model->term_of(column.parameter)];
    if (term.effect->rules.of_set_up) continue;
    const Parameter& parameter = problem.base_model->parameter(column.parameter);
    gains.push_back({label_of(term), parameter.name, parameter.unit, static_cast<Eigen::Index>(k), column.scale});
  }
  auto next = static_cast<Eigen::Index>(linearisation.linear.is_flat.size());
  for (const std::size_t i : set.signatures) {
    const Signature& signature = problem.library.signatures[i];
    const BoundEffect& bound = problem.library.families[signature.family].bound;
    for (const Parameter& parameter : bound.effect->parameters) {
      // One of several gains is not meaningful alone.
      if (parameter.kind != ParameterKind::gain || signature.width != 1) continue;
      gains.push_back(
          {label_of(bound), parameter.name, parameter.unit, next, 1.0 / problem.deviation[signature.first]});
    }
    next += signature.width;
  }
  return gains;
}

// The model with these columns split by run, those of each run one after the other at the end.
LinearModel by_run(const LinearModel& model, const std::vector<Eigen::Index>& columns,
                   const std::vector<RowRange>& runs) {
  const auto is_split = [&](Eigen::Index k) { return std::find(columns.begin(), columns.end(), k) != columns.end(); };
  LinearModel result;
  std::vector<Eigen::Index> kept{0};
  for (Eigen::Index k = 0; k + 1 < model.columns.cols(); ++k) {
    if (is_split(k)) continue;
    kept.push_back(1 + k);
    result.is_flat.push_back(model.is_flat[static_cast<std::size_t>(k)]);
  }
  result.columns = model.columns(Eigen::all, kept);
  for (const Eigen::Index k : columns) {
    Eigen::MatrixXd split = Eigen::MatrixXd::Zero(model.columns.rows(), static_cast<Eigen::Index>(runs.size()));
    for (std::size_t r = 0; r < runs.size(); ++r) {
      const auto begin = static_cast<Eigen::Index>(runs[r].begin), n = static_cast<Eigen::Index>(runs[r].end) - begin;
      split.col(static_cast<Eigen::Index>(r)).segment(begin, n) = model.columns.col(1 + k).segment(begin, n);
    }
    result = with_columns(std::move(result), split, true);
  }
  return result;
}

// The covariance at which the gains of each run are most likely: with a common gain the differences would count as
// noise.
NoiseFilter filter_by_run(const Problem& problem, const LinearModel& model) {
  std::vector<NoiseFilter> filters;
  std::vector<double> log_weight;
  for (const Covariance& covariance : likeliest_covariances(problem, model)) {
    filters.push_back(noise_filter_at(problem, covariance));
    log_weight.push_back(linear_solution(filters.back().whitening, model, problem.known).log_evidence +
                         covariance.log_prior);
  }
  return filters[static_cast<std::size_t>(std::max_element(log_weight.begin(), log_weight.end()) - log_weight.begin())];
}

}  // namespace

std::vector<GainByRun> gains_by_run(const Problem& problem, const Posterior& posterior, const EffectSet& set) {
  std::vector<GainByRun> differ;
  const std::vector<RowRange> runs = runs_of(problem.time_s);
  if (problem.model.level != Level::series || runs.size() < 2) return differ;
  const std::vector<GainColumn> gains = gain_columns(problem, posterior, set);
  if (gains.empty()) return differ;
  const LinearModel model =
      with_signatures(problem, posterior.linearisations[set.linearisation].linear, set.signatures);
  std::vector<Eigen::Index> columns;
  for (const GainColumn& gain : gains) columns.push_back(gain.column);
  const LinearModel all_by_run = by_run(model, columns, runs);
  const NoiseFilter filter = filter_by_run(problem, all_by_run);
  const double variance = linear_solution(filter.whitening, all_by_run, problem.known).variance;
  const auto solved = [&](const LinearModel& linear) {
    return solution_at(gram_of(filter.whitening, linear.columns), linear.is_flat, variance);
  };
  const double together = solved(model).square;
  const auto count = static_cast<Eigen::Index>(runs.size());
  for (const GainColumn& gain : gains) {
    const LinearSolution each = solved(by_run(model, {gain.column}, runs));
    const double p = chi2_upper_tail((together - each.square) / variance, runs.size() - 1);
    if (!(p < problem.tuning.same_gain / static_cast<double>(gains.size()))) continue;
    const Eigen::VectorXd sigma = each.covariance().diagonal().cwiseSqrt();
    GainByRun found{gain.effect, gain.parameter, gain.unit, p, {}, {}};
    for (Eigen::Index k = sigma.size() - count; k < sigma.size(); ++k) {
      found.gain.push_back(gain.scale * each.coefficients[k]);
      found.sigma.push_back(gain.scale * sigma[k]);
    }
    differ.push_back(std::move(found));
  }
  return differ;
}

}  // namespace ballbar
