#include "diagnosis/verdict/member_tests.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>
#include <utility>

#include "ballbar/internal/numerics/order_statistic.hpp"
#include "diagnosis/posterior/hyperparameters.hpp"
#include "diagnosis/posterior/robust.hpp"
#include "diagnosis/verdict/start_values.hpp"
#include "numerics/tails.hpp"
#include "series/folds.hpp"

namespace ballbar {
namespace {

constexpr double kLeftOutRidge = 1e-4;  // prior precision of a white column of length 1
constexpr double kOwnDirection = 1e-3;  // length of a gain of one cycle, of the largest, that is one
constexpr double kRoundingOf = 1e-8;    // of products of two columns

std::vector<Eigen::Index> range(Eigen::Index first, Eigen::Index count) {
  std::vector<Eigen::Index> indices(static_cast<std::size_t>(count));
  std::iota(indices.begin(), indices.end(), first);
  return indices;
}

std::vector<Eigen::Index> all_of(const SetRegression& at) { return range(0, at.size()); }

// The coefficients of all but this member.
std::vector<Eigen::Index> others_of(const SetRegression& at, std::size_t member) {
  std::vector<Eigen::Index> others;
  for (Eigen::Index k = 0; k < at.size(); ++k) {
    if (k < at.first[member] || k >= at.first[member] + at.width[member]) others.push_back(k);
  }
  return others;
}

std::vector<std::vector<Eigen::Index>> rows_by_fold(const std::vector<std::size_t>& fold) {
  std::vector<std::vector<Eigen::Index>> rows(*std::max_element(fold.begin(), fold.end()) + 1);
  for (std::size_t i = 0; i < fold.size(); ++i) rows[fold[i]].push_back(static_cast<Eigen::Index>(i));
  return rows;
}

// The places of y and of these coefficients among the columns.
std::vector<Eigen::Index> with_y(const std::vector<Eigen::Index>& coefficients) {
  std::vector<Eigen::Index> places{0};
  for (const Eigen::Index k : coefficients) places.push_back(1 + k);
  return places;
}

// The diagonal of the prior of these columns, at the scatter of the set.
Eigen::VectorXd precision_at(const SetRegression& at, const std::vector<Eigen::Index>& columns) {
  return precision_of(at.model.is_flat, at.solution.variance)(columns);
}

NormalFactor factor_of(const SetRegression& at, const std::vector<Eigen::Index>& columns) {
  const auto p = static_cast<Eigen::Index>(columns.size());
  const Eigen::MatrixXd products = at.gram.products(with_y(columns), with_y(columns));
  return NormalFactor(products.bottomRightCorner(p, p), precision_at(at, columns));
}

// The test of equal gains: the member's columns, split by fold, beside the set. With L the products of their parts
// orthogonal to it and b those with y, chi^2 = b' L^+ b / s^2. Its degrees of freedom are the directions in which they
// differ.
double p_same_gain(const SetRegression& at, std::size_t member, const std::vector<std::vector<Eigen::Index>>& rows) {
  const Eigen::Index w = at.width[member], p = at.size();
  const NormalFactor factor = factor_of(at, all_of(at));
  Eigen::MatrixXd with_all(1 + p, w * static_cast<Eigen::Index>(rows.size()));
  Eigen::MatrixXd left = Eigen::MatrixXd::Zero(with_all.cols(), with_all.cols());
  for (std::size_t f = 0; f < rows.size(); ++f) {
    const Eigen::MatrixXd part = at.white(rows[f], Eigen::all);
    const Eigen::Index first = w * static_cast<Eigen::Index>(f);
    const auto columns = part.middleCols(1 + at.first[member], w);
    with_all.middleCols(first, w).noalias() = part.transpose() * columns;
    left.block(first, first, w, w).noalias() = columns.transpose() * columns;
  }
  const double before = left.diagonal().maxCoeff();
  const Eigen::MatrixXd explained = factor.explained(with_all.bottomRows(p));
  left -= explained.transpose() * explained;
  const Eigen::VectorXd b =
      with_all.row(0).transpose() - explained.transpose() * factor.explained(at.gram.products.col(0).tail(p));
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(left);
  const double least = std::max(kOwnDirection * kOwnDirection * eigen.eigenvalues().maxCoeff(), kRoundingOf * before);
  double chi2 = 0.0;
  std::size_t degrees = 0;
  for (Eigen::Index k = 0; k < left.cols(); ++k) {
    if (!(eigen.eigenvalues()[k] > least)) continue;
    chi2 += std::pow(eigen.eigenvectors().col(k).dot(b), 2) / eigen.eigenvalues()[k] / at.solution.variance;
    ++degrees;
  }
  return degrees == 0 ? 1.0 : chi2_upper_tail(chi2, degrees);
}

// The readings of each fold, predicted from all others: ln of their likelihood, and the residual in um.
struct LeftOutFit {
  std::vector<double> log_likelihood;  // of each fold
  double rmse_um = 0.0;
};

LeftOutFit left_out(const SetRegression& at, const std::vector<Eigen::Index>& columns,
                    const std::vector<std::vector<Eigen::Index>>& rows) {
  const std::vector<Eigen::Index> places = with_y(columns);
  const Eigen::MatrixXd all = at.gram.products(places, places);
  const auto k = static_cast<Eigen::Index>(columns.size());
  Eigen::VectorXd precision = precision_at(at, columns);
  precision += kLeftOutRidge * (all.diagonal().tail(k) + precision);
  // ln of the likelihood of some readings, and the most likely coefficients.
  const auto fitted = [&](const Eigen::MatrixXd& products) {
    const NormalFactor factor(products.bottomRightCorner(k, k), precision);
    const Eigen::VectorXd explained = factor.explained(products.col(0).tail(k));
    return std::pair{
        -0.5 * (products(0, 0) - explained.squaredNorm()) / at.solution.variance - factor.half_log_determinant(),
        factor.coefficients(explained)};
  };
  const double together = fitted(all).first;
  const Eigen::MatrixXd plain = at.model.columns.rightCols(at.size())(Eigen::all, columns);
  LeftOutFit result;
  for (const std::vector<Eigen::Index>& out : rows) {
    const Eigen::MatrixXd part = at.white(out, places);
    const auto [rest, coefficients] = fitted(all - part.transpose() * part);
    result.log_likelihood.push_back(together - rest);
    for (const Eigen::Index row : out)
      result.rmse_um += std::pow(at.model.columns(row, 0) - plain.row(row).dot(coefficients), 2);
  }
  result.rmse_um = std::sqrt(result.rmse_um / static_cast<double>(at.white.rows()));
  return result;
}

// What the others leave of the member.
Eigen::MatrixXd left_of(const SetRegression& at, std::size_t member) {
  const std::vector<Eigen::Index> others = others_of(at, member);
  const Eigen::MatrixXd white = at.white.rightCols(at.size());
  const Eigen::MatrixXd beside = white(Eigen::all, others);
  Eigen::MatrixXd left = white.middleCols(at.first[member], at.width[member]);
  const NormalFactor factor = factor_of(at, others);
  const Eigen::MatrixXd explained = factor.explained(beside.transpose() * left);
  for (Eigen::Index k = 0; k < left.cols(); ++k) left.col(k) -= beside * factor.coefficients(explained.col(k));
  return left;
}

// A reading alone at a row, a change at that row that the noise forgets afterwards, and one that it has forgotten the
// further a reading lies before the row.
Eigen::MatrixXd forgotten_changes(const Problem& problem, const Covariance& covariance, Eigen::Index row) {
  const std::vector<double>& time_s = problem.time_s;
  const auto n = static_cast<Eigen::Index>(time_s.size());
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(n, 3);
  columns(row, 0) = 1.0;
  if (!(covariance.correlated > 0.0)) return columns;
  const auto kept_from = [&](Eigen::Index from, Eigen::Index i) {
    const double apart_s = time_s[static_cast<std::size_t>(i)] - time_s[static_cast<std::size_t>(from)];
    return std::exp(-std::abs(apart_s) / covariance.time_s);
  };
  for (Eigen::Index i = row; i < n; ++i) columns(i, 1) = kept_from(row, i);
  for (Eigen::Index i = 0; i < row; ++i) columns(i, 2) = kept_from(row - 1, i);
  return columns;
}

// The decay of an unknown state at the first row.
Eigen::MatrixXd decays_of_start(const Problem& problem) {
  constexpr double kTimes_s[] = {300.0, 1000.0, 3000.0, 10000.0};
  Eigen::MatrixXd columns(static_cast<Eigen::Index>(problem.time_s.size()), std::size(kTimes_s));
  for (Eigen::Index i = 0; i < columns.rows(); ++i) {
    const double since_s = problem.time_s[static_cast<std::size_t>(i)] - problem.time_s.front();
    for (Eigen::Index k = 0; k < columns.cols(); ++k) columns(i, k) = std::exp(-since_s / kTimes_s[k]);
  }
  return columns;
}

// What a stepped input that changes near this time may add from then on: all of it at once or with a lag, or for a
// while.
Eigen::MatrixXd responses_to_switches(const Problem& problem, double near_s) {
  constexpr double kNear_s = 300.0, kTimes_s[] = {1.0, 100.0, 300.0, 1000.0};
  const std::vector<double>& rows_s = problem.logged.series.time_s;
  std::vector<double> changes_s;
  for (const LoggedInput& input : problem.logged.inputs) {
    for (const Jump& jump : input.jumps) {
      const double at_s = 0.5 * (rows_s[jump.first] + rows_s[jump.last]);
      if (std::abs(at_s - near_s) < kNear_s) changes_s.push_back(at_s);
    }
  }
  constexpr auto kResponses = 2 * static_cast<Eigen::Index>(std::size(kTimes_s));
  Eigen::MatrixXd columns(static_cast<Eigen::Index>(problem.time_s.size()),
                          kResponses * static_cast<Eigen::Index>(changes_s.size()));
  Eigen::Index k = 0;
  for (const double change_s : changes_s) {
    for (const double time_s : kTimes_s) {
      for (Eigen::Index i = 0; i < columns.rows(); ++i) {
        const double since_s = problem.time_s[static_cast<std::size_t>(i)] - change_s;
        columns(i, k + 1) = since_s > 0.0 ? std::exp(-since_s / time_s) : 0.0;
        columns(i, k) = since_s > 0.0 ? 1.0 - columns(i, k + 1) : 0.0;
      }
      k += 2;
    }
  }
  return columns;
}

// The fall of chi^2 by each of these white columns alone, in place of the member.
Eigen::VectorXd falls_by(const SetRegression& at, std::size_t member, const Eigen::MatrixXd& columns) {
  const std::vector<Eigen::Index> others = others_of(at, member);
  const Eigen::MatrixXd beside = at.white.rightCols(at.size())(Eigen::all, others);
  const NormalFactor factor = factor_of(at, others);
  const Eigen::VectorXd y = at.white.col(0), of_y = factor.explained(beside.transpose() * y);
  const Eigen::MatrixXd explained = factor.explained(beside.transpose() * columns);
  Eigen::VectorXd falls = Eigen::VectorXd::Zero(columns.cols());
  for (Eigen::Index k = 0; k < columns.cols(); ++k) {
    const double square = columns.col(k).squaredNorm() - explained.col(k).squaredNorm();
    const double along = columns.col(k).dot(y) - explained.col(k).dot(of_y);
    if (square > 1e-9) falls[k] = along * along / square / at.solution.variance;
  }
  return falls;
}

// What explains nearly as much as the jump: one reading, or a change within the memory of the noise; a machine that was
// not at rest at the first row; an input that is switched.
std::vector<Doubt> doubts_of_jump(const Problem& problem, const NoiseFilter& filter, const SetRegression& at,
                                  std::size_t member) {
  if (!std::is_sorted(problem.time_s.begin(), problem.time_s.end())) return {};  // several runs
  const Eigen::VectorXd jump = at.model.columns.col(1 + at.first[member]);
  Eigen::Index before = 0;
  (jump.tail(jump.size() - 1) - jump.head(jump.size() - 1)).cwiseAbs().maxCoeff(&before);
  const Eigen::MatrixXd changes = whitened(filter.whitening, forgotten_changes(problem, filter.covariance, before + 1)),
                        decays = whitened(filter.whitening, decays_of_start(problem));
  const Eigen::MatrixXd responses =
      whitened(filter.whitening, responses_to_switches(problem, problem.time_s[static_cast<std::size_t>(before) + 1]));
  Eigen::MatrixXd columns(changes.rows(), 1 + changes.cols() + decays.cols() + responses.cols());
  columns << at.white.col(1 + at.first[member]), changes, decays, responses;
  const Eigen::VectorXd falls = falls_by(at, member, columns);
  const auto is_near = [&](const auto& of_rivals) {
    return of_rivals.size() > 0 && falls[0] < of_rivals.maxCoeff() + kLeastLikelihoodRatio;
  };
  std::vector<Doubt> doubts;
  if (is_near(falls.segment(1, changes.cols()))) doubts.push_back(Doubt::forgotten_change);
  if (is_near(falls.segment(1 + changes.cols(), decays.cols()))) doubts.push_back(Doubt::warm_start);
  if (is_near(falls.tail(responses.cols()))) doubts.push_back(Doubt::switched_input);
  return doubts;
}

// The model with these columns alone.
LinearSolution solution_with(const Gram& gram, const std::vector<char>& is_flat, const KnownScatter& known,
                             const std::vector<Eigen::Index>& columns) {
  const std::vector<Eigen::Index> places = with_y(columns);
  std::vector<char> flat;
  for (const Eigen::Index k : columns) flat.push_back(is_flat[static_cast<std::size_t>(k)]);
  return linear_solution({gram.rows, gram.log_determinant, gram.products(places, places)}, flat, known);
}

// The share of the fall of chi^2 by the member that remains where one clock is open, that of all inputs against the
// readings: a logger stamps the begin or the end of a sample, or its mean. To first order that adds the change of what
// the others explain.
double share_beside_open_clock(const Problem& problem, const NoiseFilter& filter, const SetRegression& at,
                               std::size_t member) {
  const std::vector<Eigen::Index> others = others_of(at, member);
  const auto log_square = [&](const LinearSolution& one) {
    return std::log(one.square + problem.known.readings * problem.known.variance);
  };
  const LinearSolution without = solution_with(at.gram, at.model.is_flat, problem.known, others);
  const Eigen::VectorXd explained = at.model.columns.rightCols(at.size())(Eigen::all, others) * without.coefficients;
  Eigen::VectorXd change = Eigen::VectorXd::Zero(explained.size());
  for (const RowRange& run : runs_of(problem.time_s)) {
    for (std::size_t row = run.begin + 1; row + 1 < run.end; ++row) {
      const auto i = static_cast<Eigen::Index>(row);
      change[i] = (explained[i + 1] - explained[i - 1]) / (problem.time_s[row + 1] - problem.time_s[row - 1]);
    }
  }
  change *= problem.tuning.clock_delay * median_step_s(problem.logged.series.time_s);
  const SetRegression open = set_regression(filter.whitening, with_columns(at.model, change, false), {}, problem.known);
  std::vector<Eigen::Index> with_clock = others;
  with_clock.push_back(at.size());
  const double fall = log_square(without) - log_square(at.solution),
               beside = log_square(solution_with(open.gram, open.model.is_flat, problem.known, with_clock)) -
                        log_square(open.solution);
  return beside < fall ? beside / fall : 1.0;
}

std::size_t family_of_member(const Problem& problem, const EffectSet& set, std::size_t member) {
  return problem.library.signatures[set.signatures[member]].family;
}

const Effect& effect_of_member(const Problem& problem, const EffectSet& set, std::size_t member) {
  return *problem.library.families[family_of_member(problem, set, member)].bound.effect;
}

}  // namespace

Candidate with_tests(Candidate one, const Effect& effect, const SetRegression& at, std::size_t member,
                     const std::vector<std::size_t>& fold, const Tuning& tuning) {
  const std::vector<std::vector<Eigen::Index>> rows = rows_by_fold(fold);
  one.p_same_gain = p_same_gain(at, member, rows);
  const LeftOutFit before = left_out(at, others_of(at, member), rows), after = left_out(at, all_of(at), rows);
  one.held_out_before_um = before.rmse_um;
  one.held_out_after_um = after.rmse_um;
  const Eigen::VectorXd square = squares_by_fold(left_of(at, member), fold).rowwise().sum();
  double best = 0.0;
  one.held_out_evidence = 0.0;
  for (std::size_t f = 0; f < rows.size(); ++f) {
    const bool moves = square[static_cast<Eigen::Index>(f)] > tuning.moves * square.maxCoeff();
    const double gained = moves ? after.log_likelihood[f] - before.log_likelihood[f] : 0.0;
    one.held_out_evidence += gained;
    best = std::max(best, gained);
  }
  one.held_out_evidence -= best;
  one.doubts = doubts_of(one, effect, tuning);
  return one;
}

double held_out_um(const Model& model, const Series& data, std::size_t target, const LoggedInputs* logged) {
  ProblemOptions alone;
  alone.search.catalogue.clear();
  alone.logged = logged;
  const std::unique_ptr<Problem> problem = problem_of(model, data, target, alone);
  if (largest_sum(*problem) == 0 || is_still(*problem)) return std::numeric_limits<double>::quiet_NaN();
  note_outliers(*problem);
  LinearModel linear = linearisation_at(*problem, std::nullopt, fitted_parameters(*problem)).linear;
  const NoiseFilter filter = likeliest_filter(*problem, with_any_forms(*problem, linear));
  const SetRegression at = set_regression(filter.whitening, std::move(linear), {}, problem->known);
  return left_out(at, all_of(at), rows_by_fold(folds_of(problem->logged.series, problem->base.row))).rmse_um;
}

void leave_cycles_out(const Model& model, const std::vector<std::size_t>& terms, const Series& data, std::size_t target,
                      std::vector<Candidate>& candidates) {
  if (candidates.empty()) return;
  const LoggedInputs logged = logged_inputs_of(model, data, target, {});
  const double after_um = held_out_um(model, data, target, &logged);
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    candidates[k].held_out_before_um = held_out_um(model_without(model, terms[k]), data, target, &logged);
    candidates[k].held_out_after_um = after_um;
  }
}

std::vector<Doubt> doubts_of(const Candidate& tested, const Effect& effect, const Tuning& tuning) {
  const bool of_recordings = effect.level == Level::recording;
  std::vector<Doubt> doubts;
  if (!(tested.likelihood_ratio >= kLeastLikelihoodRatio)) {
    doubts.push_back(Doubt::weak_evidence);
  } else if (tested.amplitude_um < kLeastSigmas * tested.amplitude_sigma_um) {
    doubts.push_back(Doubt::uncertain_size);
  }
  if (effect.time_only && !effect.rules.may_repeat && !of_recordings) {
    doubts.push_back(Doubt::time_alone);
    return doubts;
  }
  // A jump happens once: cycles have no gains of their own.
  if (tested.p_same_gain < tuning.same_gain && (of_recordings || !is_jump(effect)))
    doubts.push_back(Doubt::gain_differs);
  if (tested.held_out_evidence < tuning.held_out_evidence && !effect.time_only) doubts.push_back(Doubt::not_predictive);
  return doubts;
}

double log_bayes_factor_of_member(const Inference& inference, const EffectSet& set, std::size_t member) {
  std::vector<std::size_t> rest = set.families;
  std::erase(rest, family_of_member(*inference.problem, set, member));
  return log_bayes_factor_beside(inference, set, rest);
}

double log_bayes_factor_beside(const Inference& inference, const EffectSet& set, const std::vector<std::size_t>& rest) {
  const Problem& problem = *inference.problem;
  const double with = log_bayes_factor(problem, inference.posterior, set.families);
  const double without = rest.empty() ? 0.0 : log_bayes_factor(problem, inference.posterior, rest);
  return std::isfinite(without) ? with - without : with;
}

Candidate described_member(const Inference& inference, const EffectSet& set, const FittedSet& fitted,
                           std::size_t member) {
  const Problem& problem = *inference.problem;
  const std::size_t family = family_of_member(problem, set, member);
  Candidate one;
  one.bound = problem.library.families[family].bound;
  one.label = label_of(one.bound);
  one.p = inference.posterior.family[family];
  std::size_t first = problem.base_model->parameters();
  for (std::size_t k = 0; k < member; ++k) first += effect_of_member(problem, set, k).parameters.size();
  const auto begin = static_cast<std::ptrdiff_t>(first);
  const auto end = begin + static_cast<std::ptrdiff_t>(one.bound.effect->parameters.size());
  one.parameters.assign(fitted.parameters.begin() + begin, fitted.parameters.begin() + end);
  one.intervals.assign(fitted.intervals.begin() + begin, fitted.intervals.begin() + end);
  one.amplitude_um = fitted.amplitude_um[member];
  one.amplitude_sigma_um = fitted.amplitude_sigma_um[member];
  one.likelihood_ratio = log_bayes_factor_of_member(inference, set, member);
  return one;
}

Candidate tested_member(const Inference& inference, const EffectSet& set, const FittedSet& fitted,
                        const SetRegression& at, std::size_t member) {
  const Problem& problem = *inference.problem;
  Candidate one = described_member(inference, set, fitted, member);
  const Signature& signature = problem.library.signatures[set.signatures[member]];
  const std::vector<std::size_t> fold =
      folds_that_tell(problem.logged.series, problem.base.row, folds_of(problem.logged.series, problem.base.row),
                      problem.library.columns.middleCols(signature.first, signature.width));
  const Effect& effect = effect_of_member(problem, set, member);
  one = with_tests(std::move(one), effect, at, member, fold, problem.tuning);
  if (problem.tuning.jump_that_stays && is_jump(effect)) {
    const std::vector<Doubt> more = doubts_of_jump(problem, inference.posterior.filters[set.filter], at, member);
    one.doubts.insert(one.doubts.end(), more.begin(), more.end());
  } else if (!is_jump(effect) && effect.level == Level::series) {
    const double share = share_beside_open_clock(problem, inference.posterior.filters[set.filter], at, member);
    if (one.likelihood_ratio >= kLeastLikelihoodRatio && share * one.likelihood_ratio < kLeastLikelihoodRatio)
      one.doubts.push_back(Doubt::open_clock);
  }
  return one;
}

}  // namespace ballbar
