#include "diagnosis/verdict/member_tests.hpp"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "diagnosis/thresholds.hpp"
#include "diagnosis/verdict/start_values.hpp"
#include "numerics/orthonormal.hpp"
#include "numerics/tails.hpp"
#include "series/folds.hpp"

namespace ballbar {
namespace {

constexpr double kHeldOutEvidence = 3.0;  // gain in ln likelihood of left-out cycles, without the best one

constexpr double kMoves = 0.05;  // of an effect's square in its largest cycle; with less it stands still: what that
                                 // cycle gains is only that the others are no longer biased
constexpr double kLeftOutRidge = 1e-4;  // prior precision of a white column of length 1
constexpr double kOwnDirection = 1e-3;  // pivot of a gain of one cycle, of the largest, that is one

double p_same_gain(const SetRegression& at, const Eigen::MatrixXd& others, const Eigen::MatrixXd& own,
                   const std::vector<std::size_t>& fold, std::size_t folds) {
  Eigen::MatrixXd by_fold = Eigen::MatrixXd::Zero(own.rows(), own.cols() * static_cast<Eigen::Index>(folds));
  for (std::size_t i = 0; i < fold.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    by_fold.block(row, static_cast<Eigen::Index>(fold[i]) * own.cols(), 1, own.cols()) = own.row(row);
  }
  Eigen::MatrixXd together(own.rows(), others.cols() + own.cols());
  together << others, own;
  const Eigen::MatrixXd basis = orthonormal(together);
  const Eigen::VectorXd r = orthogonal_part(at.white_y, basis);
  const Eigen::MatrixXd left = orthogonal_part(by_fold, basis);
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(left);
  qr.setThreshold(kOwnDirection);
  const Eigen::Index degrees = qr.rank();
  if (degrees == 0) return 1.0;
  const Eigen::MatrixXd directions = qr.householderQ() * Eigen::MatrixXd::Identity(left.rows(), degrees);
  const double chi2 = (directions.transpose() * r).squaredNorm() / at.variance;
  return chi2_upper_tail(chi2, static_cast<std::size_t>(degrees));
}

// The readings of each fold, predicted from all others: ln of their likelihood, and the residual in um.
struct LeftOutFit {
  std::vector<double> log_likelihood;  // of each fold
  double rmse_um = 0.0;
};

LeftOutFit left_out(const SetRegression& at, const Eigen::MatrixXd& white, const Eigen::MatrixXd& plain,
                    const std::vector<std::size_t>& fold, std::size_t folds) {
  const Eigen::Index k = white.cols();
  const Eigen::VectorXd scale = white.colwise().norm().cwiseMax(1e-300).cwiseInverse();
  const Eigen::MatrixXd x = white * scale.asDiagonal();
  Eigen::MatrixXd gram = x.transpose() * x;
  gram.diagonal().array() += kLeftOutRidge;
  const Eigen::VectorXd xy = x.transpose() * at.white_y;
  const double yy = at.white_y.squaredNorm();
  const auto evidence = [&](const Eigen::MatrixXd& g, const Eigen::VectorXd& b, double square, Eigen::VectorXd* beta) {
    const Eigen::LLT<Eigen::MatrixXd> factor(g);
    const Eigen::VectorXd solution = factor.solve(b);
    if (beta != nullptr) *beta = solution;
    const Eigen::MatrixXd lower = factor.matrixL();
    return -0.5 * (square - b.dot(solution)) / at.variance - lower.diagonal().array().max(1e-300).log().sum();
  };
  const double all = evidence(gram, xy, yy, nullptr);
  LeftOutFit result;
  result.log_likelihood.resize(folds);
  for (std::size_t out = 0; out < folds; ++out) {
    std::vector<Eigen::Index> rows;
    for (std::size_t i = 0; i < fold.size(); ++i) {
      if (fold[i] == out) rows.push_back(static_cast<Eigen::Index>(i));
    }
    const Eigen::MatrixXd own = x(rows, Eigen::all);
    const Eigen::VectorXd own_y = at.white_y(rows);
    Eigen::VectorXd beta(k);
    const double rest =
        evidence(gram - own.transpose() * own, xy - own.transpose() * own_y, yy - own_y.squaredNorm(), &beta);
    result.log_likelihood[out] = all - rest;
    const Eigen::VectorXd coefficients = scale.asDiagonal() * beta;
    for (const Eigen::Index row : rows) result.rmse_um += std::pow(at.y[row] - plain.row(row).dot(coefficients), 2);
  }
  result.rmse_um = std::sqrt(result.rmse_um / static_cast<double>(fold.size()));
  return result;
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
  const std::size_t folds = *std::max_element(fold.begin(), fold.end()) + 1;
  const Eigen::MatrixXd others = at.white_columns_but(member), plain_others = at.columns_but(member);
  const Eigen::MatrixXd own = at.white_members.middleCols(at.first[member], at.width[member]);
  Eigen::MatrixXd with(others.rows(), others.cols() + own.cols()), plain_with(plain_others.rows(), with.cols());
  with << others, own;
  plain_with << plain_others, at.members.middleCols(at.first[member], at.width[member]);
  one.p_same_gain = p_same_gain(at, others, own, fold, folds);
  const LeftOutFit before = left_out(at, others, plain_others, fold, folds);
  const LeftOutFit after = left_out(at, with, plain_with, fold, folds);
  one.held_out_before_um = before.rmse_um;
  one.held_out_after_um = after.rmse_um;
  // Of what the others leave of the effect.
  const Eigen::VectorXd square = squares_by_fold(orthogonal_part(own, orthonormal(others)), fold).rowwise().sum();
  double best = 0.0;
  one.held_out_evidence = 0.0;
  for (std::size_t f = 0; f < folds; ++f) {
    const bool moves = square[static_cast<Eigen::Index>(f)] > kMoves * square.maxCoeff();
    const double gained = moves ? after.log_likelihood[f] - before.log_likelihood[f] : 0.0;
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
                                 [](const EffectSet& set) { return set.families.empty() && set.own == 0; });
  const SetRegression at = set_regression(problem, found.posterior, *none);
  const std::vector<std::size_t> fold = folds_of(problem.logged.series, problem.base.row);
  return left_out(at, at.white_line, at.line, fold, *std::max_element(fold.begin(), fold.end()) + 1).rmse_um;
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
  if (tuning.same_gain && tested.p_same_gain < kSameGain && (of_recordings || !is_jump(effect)))
    doubts.push_back(Doubt::gain_differs);
  if (tuning.held_out && tested.held_out_evidence < kHeldOutEvidence && !effect.time_only)
    doubts.push_back(Doubt::not_predictive);
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
  return with_tests(std::move(one), effect, at, member, fold, problem.tuning);
}

}  // namespace ballbar
