#include "predict/ridge.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "ballbar/internal/numerics/parallel.hpp"
#include "predict/likelihood_along_variance.hpp"

namespace ballbar {
namespace {

constexpr double kRemembered = 0.98;  // of s^2
constexpr double kLengths_s[] = {0.0, 1800.0, 7200.0, 30'000.0};
constexpr int kLeastVariance = -4, kMostVariance = 10, kLeastSpread = -12;  // v = 10^(k/2)

unsigned bit(PredictorKind kind) { return 1U << static_cast<unsigned>(kind); }

// What a dictionary adds to another makes no sense without it.
bool makes_sense(unsigned kinds) {
  const auto has = [&](PredictorKind kind) { return (kinds & bit(kind)) != 0; };
  if (has(PredictorKind::feedback) && !has(PredictorKind::source)) return false;
  if (has(PredictorKind::difference) && !has(PredictorKind::temperature)) return false;
  return !has(PredictorKind::start) || has(PredictorKind::temperature);
}

std::vector<unsigned> dictionaries_of(const RidgeProblem& problem) {
  unsigned there = 0;
  for (std::size_t kind = 0; kind < kPredictorKinds; ++kind) {
    if (problem.prior[kind].size() > 0) there |= 1U << kind;
  }
  std::vector<unsigned> dictionaries;
  for (unsigned kinds = 0; kinds < (1U << kPredictorKinds); ++kinds) {
    if ((kinds & ~there) == 0 && makes_sense(kinds)) dictionaries.push_back(kinds);
  }
  return dictionaries;
}

// Of all predictors, over s^2.
Eigen::MatrixXd prior_of(const RidgeProblem& problem, const RidgeSetting& setting) {
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(problem.columns.cols(), problem.columns.cols());
  for (std::size_t kind = 0; kind < kPredictorKinds; ++kind) {
    if ((setting.kinds >> kind & 1U) != 0 && problem.prior[kind].size() > 0)
      sum += setting.variance * problem.prior[kind];
  }
  for (const std::size_t k : problem.named) {
    const auto at = static_cast<Eigen::Index>(k);
    sum(at, at) = setting.named_variance;
  }
  if (problem.start.size() > 0) sum += (setting.start_scale + setting.variance) * problem.start_covariance;
  return sum;
}

// X~ C X~', of gains with this covariance.
Eigen::MatrixXd kernel_of(const RidgeProblem& problem, const Eigen::MatrixXd& covariance) {
  Eigen::MatrixXd kernel = Eigen::MatrixXd::Zero(problem.columns.rows(), problem.columns.rows());
  if (covariance.isZero(0.0)) return kernel;
  kernel.triangularView<Eigen::Lower>() = (problem.columns * covariance) * problem.columns.transpose();
  return kernel.selfadjointView<Eigen::Lower>();
}

// K less N. Machines are apart along what the others leave open as well: v is of both.
Eigen::MatrixXd kernel_of(const RidgeProblem& problem, const RidgeSetting& setting) {
  return kernel_of(problem, prior_of(problem, setting));
}

// K solved for what is asked of it.
struct Solved {
  Eigen::LLT<Eigen::MatrixXd> root;
  Eigen::VectorXd of_ones, of_target;  // K^-1 1, K^-1 (y - b)
  double q = 0.0, intercept_um = 0.0, variance_um2 = 0.0, log_likelihood = 0.0;
};

// covariance: K.
Solved solved(const RidgeProblem& problem, const Eigen::MatrixXd& covariance) {
  const Eigen::Index n = problem.columns.rows();
  Solved result;
  result.root.compute(covariance);
  Eigen::MatrixXd sides(n, 2);
  sides.col(0).setOnes();
  sides.col(1) = problem.target_um;
  result.root.solveInPlace(sides);
  result.q = sides.col(0).sum();
  result.intercept_um = sides.col(1).sum() / result.q;
  result.of_ones = sides.col(0);
  result.of_target = sides.col(1) - result.intercept_um * sides.col(0);
  const double degrees = static_cast<double>(n - 1);
  const double sum = (problem.target_um.array() - result.intercept_um).matrix().dot(result.of_target);
  result.variance_um2 = std::max(sum / degrees, std::numeric_limits<double>::min());
  const double half_log_det = result.root.matrixLLT().diagonal().array().log().sum();
  result.log_likelihood = -0.5 * degrees * std::log(result.variance_um2) - half_log_det - 0.5 * std::log(result.q);
  return result;
}

std::size_t runs_in(const RidgeProblem& problem) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < problem.run.size(); ++i) count += i == 0 || problem.run[i] != problem.run[i - 1] ? 1 : 0;
  return count;
}

// Q, n by n.
Eigen::MatrixXd without_constant(const Solved& of) {
  const Eigen::Index n = of.of_ones.size();
  Eigen::MatrixXd q = of.root.solve(Eigen::MatrixXd::Identity(n, n));
  q.noalias() -= of.of_ones * of.of_ones.transpose() / of.q;
  return q;
}

LeftOutRuns left_out(const RidgeProblem& problem, const Solved& of, bool with_sigma) {
  const Eigen::Index n = problem.columns.rows();
  const Eigen::MatrixXd q = without_constant(of);
  LeftOutRuns result{Eigen::VectorXd(n), Eigen::VectorXd(with_sigma ? n : 0), {}};
  for (Eigen::Index first = 0; first < n;) {
    Eigen::Index end = first;
    while (end < n && problem.run[static_cast<std::size_t>(end)] == problem.run[static_cast<std::size_t>(first)]) ++end;
    const Eigen::Index size = end - first;
    const auto of_run = q.block(first, first, size, size).ldlt();
    result.error_um.segment(first, size) = of_run.solve(of.of_target.segment(first, size));
    result.rmse_um.push_back(std::sqrt(result.error_um.segment(first, size).squaredNorm() / static_cast<double>(size)));
    if (with_sigma) {
      result.sigma_um.segment(first, size) =
          (of_run.solve(Eigen::MatrixXd::Identity(size, size)).diagonal() * of.variance_um2).cwiseAbs().cwiseSqrt();
    }
    first = end;
  }
  return result;
}

Solved solved(const RidgeProblem& problem, const RidgeSetting& setting) {
  return solved(problem, kernel_of(problem, setting) + discrepancy_of(problem.time_s, problem.run, setting.length_s));
}

// The larger, the better.
double score_of(const RidgeProblem& problem, const Solved& of) {
  if (of.root.info() != Eigen::Success || !std::isfinite(of.log_likelihood)) {
    return -std::numeric_limits<double>::infinity();
  }
  if (runs_in(problem) < kFewestRunsToLeaveOut) return of.log_likelihood;
  double sum = 0.0;
  for (const double rmse : left_out(problem, of, false).rmse_um) sum += rmse * rmse;
  return std::isfinite(sum) ? -sum : -std::numeric_limits<double>::infinity();
}

// X~ P X~' of each kind and, last, of the start; for v = 1.
std::vector<Eigen::MatrixXd> kernels_of(const RidgeProblem& problem) {
  std::vector<Eigen::MatrixXd> kernels(kPredictorKinds + 1);
  in_parallel(kernels.size(), [&](std::size_t kind) {
    kernels[kind] =
        kernel_of(problem, kind < kPredictorKinds ? problem.prior[kind] : prior_of(problem, {.start_scale = 0.0}));
  });
  return kernels;
}

// Of a dictionary, with the start.
Eigen::MatrixXd sum_of(const std::vector<Eigen::MatrixXd>& kernels, unsigned kinds) {
  Eigen::MatrixXd sum = kernels.back();
  for (std::size_t kind = 0; kind < kPredictorKinds; ++kind) {
    if ((kinds >> kind & 1U) != 0) sum += kernels[kind];
  }
  return sum;
}

RidgeSetting best_setting(const RidgeProblem& problem, double named_variance, double start_scale) {
  struct RatedSetting {
    RidgeSetting setting;
    double score = -std::numeric_limits<double>::infinity();
  };
  const std::vector<unsigned> dictionaries = dictionaries_of(problem);
  constexpr std::size_t kLengths = std::size(kLengths_s);
  // Machines that are alike need next to no spread.
  const int least = problem.start.size() > 0 ? kLeastSpread : kLeastVariance;
  const bool by_runs = runs_in(problem) >= kFewestRunsToLeaveOut;
  // K is factorised for each v where that needs more than the likelihood, or there are few rows for the predictors.
  const bool is_reduced = !by_runs && problem.start.size() == 0 && 2 * problem.columns.cols() <= problem.columns.rows();
  std::vector<Eigen::MatrixXd> rests(is_reduced ? 0 : kLengths), kernels;
  std::vector<WhiteProducts> products(is_reduced ? kLengths : 0);
  std::vector<PriorRoot> roots(is_reduced ? dictionaries.size() : 0);
  if (!is_reduced) {
    kernels = kernels_of(problem);
    const Eigen::MatrixXd fixed =
        kernel_of(problem, RidgeSetting{.variance = 0.0, .named_variance = named_variance, .start_scale = start_scale});
    for (std::size_t length = 0; length < kLengths; ++length)
      rests[length] = fixed + discrepancy_of(problem.time_s, problem.run, kLengths_s[length]);
  }
  in_parallel(products.size(), [&](std::size_t length) {
    products[length] = white_products(problem, kLengths_s[length], named_variance);
  });
  in_parallel(roots.size(),
              [&](std::size_t d) { roots[d] = prior_root(prior_of(problem, {.kinds = dictionaries[d]})); });
  std::vector<RatedSetting> tried(dictionaries.size() * kLengths);
  in_parallel(tried.size(), [&](std::size_t i) {
    const unsigned kinds = dictionaries[i / kLengths];
    const std::size_t length = i % kLengths;
    Eigen::MatrixXd kernel;
    std::optional<LikelihoodAlongVariance> reduced;
    if (is_reduced) {
      reduced.emplace(products[length], roots[i / kLengths]);
    } else {
      kernel = sum_of(kernels, kinds);
    }
    std::map<int, double> known;
    const auto score = [&](int k) {
      const auto [place, is_new] = known.try_emplace(k, 0.0);
      if (is_new) {
        const double variance = std::pow(10.0, 0.5 * k);
        place->second =
            reduced ? reduced->at(variance) : score_of(problem, solved(problem, variance * kernel + rests[length]));
      }
      return place->second;
    };
    const auto uphill_from = [&](int best) {
      for (const int step : {2, 1}) {  // in whole, then in half powers of 10
        for (const int sign : {1, -1}) {
          for (int k = best + sign * step; k >= least && k <= kMostVariance && score(k) > score(best);
               k = best + sign * step) {
            best = k;
          }
        }
      }
      return best;
    };
    int best = uphill_from(0);
    if (by_runs) {
      const int other = uphill_from(6);
      if (score(other) > score(best)) best = other;
    }
    tried[i] = {{kinds, std::pow(10.0, 0.5 * best), kLengths_s[length], named_variance, start_scale}, score(best)};
  });
  return std::max_element(tried.begin(), tried.end(),
                          [](const RatedSetting& a, const RatedSetting& b) { return a.score < b.score; })
      ->setting;
}

}  // namespace

double remembered(double since_s, double length_s) {
  return length_s > 0.0 ? kRemembered * std::exp(-since_s / length_s) : 0.0;
}

Eigen::MatrixXd discrepancy_of(const std::vector<double>& time_s, const std::vector<std::size_t>& run,
                               double length_s) {
  const auto n = static_cast<Eigen::Index>(time_s.size());
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Identity(n, n);
  if (!(length_s > 0.0)) return covariance;
  for (Eigen::Index j = 0; j < n; ++j) {
    for (Eigen::Index i = j + 1; i < n; ++i) {
      const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
      if (run[a] == run[b]) {
        covariance(i, j) = covariance(j, i) = remembered(std::abs(time_s[a] - time_s[b]), length_s);
      }
    }
  }
  return covariance;
}

Eigen::VectorXd discrepancy_at_end(const RidgeProblem& problem, double length_s) {
  Eigen::VectorXd end = Eigen::VectorXd::Zero(problem.columns.rows());
  for (std::size_t i = 0; i < problem.run.size(); ++i) {
    if (problem.run[i] != problem.run.back()) continue;
    end[static_cast<Eigen::Index>(i)] = remembered(problem.end_s - problem.time_s[i], length_s);
  }
  return end;
}

RidgeSetting chosen_setting(const RidgeProblem& problem) {
  const RidgeSetting without = chosen_setting(problem, 0.0);
  if (problem.named.empty()) return without;
  const RidgeSetting with = chosen_setting(problem, kFreeNamed);
  return score_of(problem, solved(problem, with)) < score_of(problem, solved(problem, without)) ? without : with;
}

RidgeSetting chosen_setting(const RidgeProblem& problem, double named_variance) {
  const RidgeSetting setting = best_setting(problem, named_variance, 1.0);
  if (problem.start.size() == 0) return setting;
  // C0 is known in um^2, K over s^2.
  const double s2 = solved(problem, setting).variance_um2;
  return best_setting(problem, named_variance, problem.start_sigma_um * problem.start_sigma_um / s2);
}

RidgeFit ridge_fit(const RidgeProblem& problem, const RidgeSetting& setting) {
  const Eigen::Index n = problem.columns.rows();
  const Solved of = solved(problem, setting);
  RidgeFit fit;
  fit.setting = setting;
  fit.sigma_um = std::sqrt(of.variance_um2);
  fit.log_likelihood = of.log_likelihood;
  const Eigen::MatrixXd of_all = prior_of(problem, setting);
  for (Eigen::Index k = 0; k < of_all.rows(); ++k) {
    if (of_all(k, k) > 0.0) fit.used.push_back(static_cast<std::size_t>(k));
  }
  const auto m = static_cast<Eigen::Index>(fit.used.size());
  const Eigen::MatrixXd prior = of_all(fit.used, fit.used);
  Eigen::MatrixXd with_target(m + 1, n);  // covariance with y, over s^2
  with_target.topRows(m).noalias() = prior * problem.columns(Eigen::all, fit.used).transpose();
  with_target.row(m) = discrepancy_at_end(problem, setting.length_s).transpose();
  fit.gains_um.resize(m + 2);
  fit.gains_um[0] = of.intercept_um;
  fit.gains_um.tail(m + 1).noalias() = with_target * of.of_target;
  if (problem.start.size() > 0) fit.gains_um.segment(1, m) += problem.start(fit.used);
  Eigen::MatrixXd half = with_target.transpose();
  of.root.matrixL().solveInPlace(half);
  Eigen::VectorXd along(m + 2);
  along << -1.0, with_target * of.of_ones;
  Eigen::MatrixXd covariance = along * along.transpose() / of.q;
  covariance.bottomRightCorner(m + 1, m + 1).noalias() -= half.transpose() * half;
  covariance.block(1, 1, m, m) += prior;
  covariance(m + 1, m + 1) += remembered(0.0, setting.length_s);
  covariance *= of.variance_um2;
  // Rounding must not make the variance negative of what is known exactly.
  covariance.diagonal().array() += 1e-12 * covariance.diagonal().cwiseAbs().maxCoeff();
  fit.factor_um = covariance.llt().matrixL();
  return fit;
}

LeftOutRuns left_out_runs(const RidgeProblem& problem, const RidgeSetting& setting) {
  return left_out(problem, solved(problem, setting), true);
}

Eigen::MatrixXd left_out_pairs_um2(const RidgeProblem& problem, const RidgeSetting& setting, std::size_t runs) {
  const Solved of = solved(problem, setting);
  const auto count = static_cast<Eigen::Index>(runs);
  if (of.root.info() != Eigen::Success) {
    return Eigen::MatrixXd::Constant(count, count, std::numeric_limits<double>::infinity());
  }
  const Eigen::MatrixXd q = without_constant(of);
  std::vector<std::vector<Eigen::Index>> rows_of(runs);
  for (std::size_t i = 0; i < problem.run.size(); ++i) rows_of[problem.run[i]].push_back(static_cast<Eigen::Index>(i));
  Eigen::MatrixXd squares = Eigen::MatrixXd::Zero(count, count);
  for (Eigen::Index r = 0; r < count; ++r) {
    for (Eigen::Index s = 0; s <= r; ++s) {
      std::vector<Eigen::Index> rows = rows_of[static_cast<std::size_t>(r)];
      const std::vector<Eigen::Index>& of_s = rows_of[static_cast<std::size_t>(s)];
      const auto of_r = static_cast<Eigen::Index>(rows.size());
      if (s != r) rows.insert(rows.end(), of_s.begin(), of_s.end());
      if (rows.empty()) continue;
      const Eigen::VectorXd error_um = q(rows, rows).ldlt().solve(of.of_target(rows));
      const Eigen::VectorXd of_first = error_um.head(of_r), of_second = error_um.tail(error_um.size() - of_r);
      if (of_first.size() > 0) squares(s, r) = of_first.squaredNorm() / static_cast<double>(of_first.size());
      if (of_second.size() > 0) squares(r, s) = of_second.squaredNorm() / static_cast<double>(of_second.size());
    }
  }
  return squares;
}

Eigen::VectorXd gains_from(const RidgeProblem& problem, const RidgeSetting& setting,
                           const std::vector<std::size_t>& rows) {
  RidgeProblem part;
  part.columns = problem.columns(rows, Eigen::all);
  part.target_um = problem.target_um(rows);
  for (const std::size_t row : rows) {
    part.time_s.push_back(problem.time_s[row]);
    part.run.push_back(problem.run[row]);
  }
  const Eigen::MatrixXd prior = prior_of(problem, setting);
  const Solved of = solved(part, kernel_of(part, prior) + discrepancy_of(part.time_s, part.run, setting.length_s));
  const Eigen::VectorXd gains = prior * (part.columns.transpose() * of.of_target);
  return problem.start.size() > 0 ? Eigen::VectorXd(gains + problem.start) : gains;
}

double log_likelihood_without(const RidgeProblem& problem, const RidgeSetting& setting,
                              const std::vector<std::size_t>& predictors) {
  Eigen::MatrixXd prior = prior_of(problem, setting);
  for (const std::size_t k : predictors) {
    prior.row(static_cast<Eigen::Index>(k)).setZero();
    prior.col(static_cast<Eigen::Index>(k)).setZero();
  }
  return solved(problem, kernel_of(problem, prior) + discrepancy_of(problem.time_s, problem.run, setting.length_s))
      .log_likelihood;
}

std::size_t named_in(const RidgeProblem& problem, const RidgeFit& fit) {
  if (problem.named.empty()) return 0;
  return static_cast<std::size_t>(
      std::count_if(fit.used.begin(), fit.used.end(), [&](std::size_t k) { return k >= problem.named.front(); }));
}

double prior_trace(const RidgeProblem& problem, const RidgeSetting& setting) {
  return (problem.columns * prior_of(problem, setting)).cwiseProduct(problem.columns).sum();
}

RidgePrediction ridge_prediction(const RidgeProblem& problem, const RidgeFit& fit,
                                 const Eigen::Ref<const Eigen::VectorXd>& x, double since_s) {
  const auto m = static_cast<Eigen::Index>(fit.used.size());
  Eigen::VectorXd scaled(m + 2);
  scaled[0] = 1.0;
  for (Eigen::Index k = 0; k < m; ++k) {
    const auto of = static_cast<Eigen::Index>(fit.used[static_cast<std::size_t>(k)]);
    scaled[k + 1] = (x[of] - problem.mean[of]) / problem.sd[of];
  }
  const double length_s = fit.setting.length_s;
  scaled[m + 1] = length_s > 0.0 && std::isfinite(since_s) ? std::exp(-since_s / length_s) : 0.0;
  const double fresh = 1.0 - remembered(0.0, length_s) * scaled[m + 1] * scaled[m + 1];
  const double known_um2 = (fit.factor_um.triangularView<Eigen::Lower>().transpose() * scaled).squaredNorm();
  return {fit.gains_um.dot(scaled), std::sqrt(known_um2 + fresh * fit.sigma_um * fit.sigma_um)};
}

}  // namespace ballbar
