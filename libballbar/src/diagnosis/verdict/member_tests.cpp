#include "diagnosis/verdict/member_tests.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "diagnosis/verdict/start_values.hpp"
#include "numerics/tails.hpp"
#include "series/folds.hpp"

namespace ballbar {
namespace {

constexpr double kLeftOutRidge = 1e-4;  // prior precision of a white column of length 1
constexpr double kOwnDirection = 1e-3;  // length of a gain of one cycle, of the largest, that is one
constexpr double kRoundingOf = 1e-8;    // of products of two columns

// The coefficients of a member, and those of all others.
std::vector<Eigen::Index> own_of(const SetRegression& at, std::size_t member) {
  std::vector<Eigen::Index> own(static_cast<std::size_t>(at.width[member]));
  std::iota(own.begin(), own.end(), at.first[member]);
  return own;
}

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

// The products of y and these columns with each other in some rows.
Eigen::MatrixXd products_in(const SetRegression& at, const std::vector<Eigen::Index>& rows,
                            const std::vector<Eigen::Index>& columns) {
  std::vector<Eigen::Index> places{0};
  for (const Eigen::Index k : columns) places.push_back(1 + k);
  const Eigen::MatrixXd part = at.white(rows, places);
  return part.transpose() * part;
}

// The diagonal of the prior of these columns, at the scatter of the set.
Eigen::VectorXd precision_at(const SetRegression& at, const std::vector<Eigen::Index>& columns) {
  return precision_of(at.model.is_flat, at.solution.variance)(columns);
}

// With gains of its own in each fold, what is left of them beside the set: chi^2 = b' L^+ b / s^2 with L their products
// and b those with y. Its degrees are the directions in which they differ.
double p_same_gain(const SetRegression& at, std::size_t member, const std::vector<std::vector<Eigen::Index>>& rows) {
  const std::vector<Eigen::Index> own = own_of(at, member);
  const Eigen::Index w = at.width[member], p = at.size();
  const Eigen::MatrixXd products = at.white.transpose() * at.white;
  const NormalFactor factor(products.bottomRightCorner(p, p), precision_of(at.model.is_flat, at.solution.variance));
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
      with_all.row(0).transpose() - explained.transpose() * factor.explained(products.col(0).tail(p));
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
  std::vector<Eigen::Index> every(static_cast<std::size_t>(at.white.rows()));
  std::iota(every.begin(), every.end(), Eigen::Index{0});
  const Eigen::MatrixXd all = products_in(at, every, columns);
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
    const auto [rest, coefficients] = fitted(all - products_in(at, out, columns));
    result.log_likelihood.push_back(together - rest);
    for (const Eigen::Index row : out)
      result.rmse_um += std::pow(at.model.columns(row, 0) - plain.row(row).dot(coefficients), 2);
  }
  result.rmse_um = std::sqrt(result.rmse_um / static_cast<double>(at.white.rows()));
  return result;
}

// The square of what the others leave of the member, in each fold.
std::vector<double> squares_left(const SetRegression& at, std::size_t member,
                                 const std::vector<std::vector<Eigen::Index>>& rows) {
  const std::vector<Eigen::Index> others = others_of(at, member);
  const Eigen::MatrixXd white = at.white.rightCols(at.size());
  const Eigen::MatrixXd beside = white(Eigen::all, others), own = white(Eigen::all, own_of(at, member));
  const NormalFactor factor(beside.transpose() * beside, precision_at(at, others));
  Eigen::MatrixXd left = own;
  const Eigen::MatrixXd explained = factor.explained(beside.transpose() * own);
  for (Eigen::Index k = 0; k < own.cols(); ++k) left.col(k) -= beside * factor.coefficients(explained.col(k));
  std::vector<double> squares;
  for (const std::vector<Eigen::Index>& of : rows) squares.push_back(left(of, Eigen::all).squaredNorm());
  return squares;
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

// The largest fall of chi^2 by one of these white columns in place of the member.
double largest_fall(const SetRegression& at, std::size_t member, const Eigen::MatrixXd& columns) {
  const std::vector<Eigen::Index> others = others_of(at, member);
  const Eigen::MatrixXd beside = at.white.rightCols(at.size())(Eigen::all, others);
  const NormalFactor factor(beside.transpose() * beside, precision_at(at, others));
  const Eigen::VectorXd y = at.white.col(0), of_y = factor.explained(beside.transpose() * y);
  const Eigen::MatrixXd explained = factor.explained(beside.transpose() * columns);
  double largest = 0.0;
  for (Eigen::Index k = 0; k < columns.cols(); ++k) {
    const double square = columns.col(k).squaredNorm() - explained.col(k).squaredNorm();
    const double along = columns.col(k).dot(y) - explained.col(k).dot(of_y);
    if (square > 1e-9) largest = std::max(largest, along * along / square / at.solution.variance);
  }
  return largest;
}

// Whether one reading, or a change within the memory of the noise, explains nearly as much as the jump.
bool is_forgotten(const Problem& problem, const NoiseFilter& filter, const SetRegression& at, std::size_t member) {
  if (!std::is_sorted(problem.time_s.begin(), problem.time_s.end())) return false;  // several runs
  const Eigen::VectorXd jump = at.model.columns.col(1 + at.first[member]);
  Eigen::Index before = 0;
  (jump.tail(jump.size() - 1) - jump.head(jump.size() - 1)).cwiseAbs().maxCoeff(&before);
  const Eigen::MatrixXd changes = whitened(filter.whitening, forgotten_changes(problem, filter.covariance, before + 1));
  const Eigen::MatrixXd itself = at.white.col(1 + at.first[member]);
  return largest_fall(at, member, itself) < largest_fall(at, member, changes) + kLeastLikelihoodRatio;
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
  std::vector<Eigen::Index> all(static_cast<std::size_t>(at.size()));
  std::iota(all.begin(), all.end(), Eigen::Index{0});
  one.p_same_gain = p_same_gain(at, member, rows);
  const LeftOutFit before = left_out(at, others_of(at, member), rows), after = left_out(at, all, rows);
  one.held_out_before_um = before.rmse_um;
  one.held_out_after_um = after.rmse_um;
  const std::vector<double> square = squares_left(at, member, rows);
  const double largest = *std::max_element(square.begin(), square.end());
  double best = 0.0;
  one.held_out_evidence = 0.0;
  for (std::size_t f = 0; f < rows.size(); ++f) {
    const double gained = square[f] > tuning.moves * largest ? after.log_likelihood[f] - before.log_likelihood[f] : 0.0;
    one.held_out_evidence += gained;
    best = std::max(best, gained);
  }
  one.held_out_evidence -= best;
  one.doubts = doubts_of(one, effect, tuning);
  return one;
}

double held_out_um(const Model& model, const Series& data, std::size_t target) {
  ProblemOptions alone;
  alone.search.catalogue.clear();
  const Inference found = inference(model, data, target, alone);
  if (found.posterior.sets.empty()) return std::numeric_limits<double>::quiet_NaN();
  const Problem& problem = *found.problem;
  const auto none = std::find_if(found.posterior.sets.begin(), found.posterior.sets.end(),
                                 [](const EffectSet& set) { return set.families.empty() && set.held == 0; });
  const SetRegression at = set_regression(problem, found.posterior, *none);
  std::vector<Eigen::Index> all(static_cast<std::size_t>(at.size()));
  std::iota(all.begin(), all.end(), Eigen::Index{0});
  return left_out(at, all, rows_by_fold(folds_of(problem.logged.series, problem.base.row))).rmse_um;
}

void leave_cycles_out(const Model& model, const std::vector<std::size_t>& terms, const Series& data, std::size_t target,
                      std::vector<Candidate>& candidates) {
  const double after_um = held_out_um(model, data, target);
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    candidates[k].held_out_before_um = held_out_um(model_without(model, terms[k]), data, target);
    candidates[k].held_out_after_um = after_um;
  }
}

std::vector<Doubt> doubts_of(const Candidate& tested, const Effect& effect, const Tuning& tuning) {
  const bool of_recordings = effect.level == Level::recording;
  if (effect.time_only && !effect.rules.may_repeat && !of_recordings) return {Doubt::time_alone};
  std::vector<Doubt> doubts;
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
  if (problem.tuning.jump_that_stays && is_jump(effect) &&
      is_forgotten(problem, inference.posterior.filters[set.filter], at, member))
    one.doubts.push_back(Doubt::forgotten_change);
  return one;
}

}  // namespace ballbar
