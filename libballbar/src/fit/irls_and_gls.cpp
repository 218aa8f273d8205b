#include "fit/irls_and_gls.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "ballbar/error.hpp"
#include "ballbar/internal/numerics/range.hpp"
#include "fit/inlier_rows.hpp"
#include "noise/whitening.hpp"
#include "numerics/median.hpp"
#include "numerics/not_finite.hpp"
#include "numerics/tukey.hpp"

namespace ballbar {
namespace {

constexpr int kRobustRounds = 8;
constexpr int kNoiseRounds = 2, kRobustNoiseRounds = 4;
constexpr int kMostSteps = 100;
constexpr double kWorseByWhitening = 1.5;  // ratio of rms: whitening discarded the slow part of the data

Eigen::VectorXd residual_of(const FitProblem& problem, const SolvedFit& solved) {
  return problem.target_um - problem.rows.sum(solved.minimum.parameters, nullptr);
}

Eigen::MatrixXd jacobian_of_free(const FitProblem& problem, const Eigen::VectorXd& p) {
  Eigen::MatrixXd all;
  problem.rows.sum(p, &all);
  Eigen::MatrixXd spent(all.rows(), static_cast<Eigen::Index>(problem.free));
  Eigen::Index used = 0;
  for (Eigen::Index k = 0; k < p.size(); ++k) {
    if (!problem.bounds.held[static_cast<std::size_t>(k)]) spent.col(used++) = all.col(k);
  }
  return spent;
}

// A correlation time longer than a tenth of the record indicates a missing effect rather than noise. Whitening by it
// would difference the data and fit only the fast part.
bool is_misfit(const Noise& noise, const std::vector<double>& time_s) {
  return noise.correlated_um > noise.white_um && noise.correlation_time_s > 0.1 * range_of(time_s);
}

}  // namespace

std::vector<double> vector_of(const Eigen::VectorXd& values) { return {values.data(), values.data() + values.size()}; }

double rms_of(const std::vector<double>& values) {
  double squares = 0.0;
  for (const double value : values) squares += value * value;
  return std::sqrt(squares / static_cast<double>(values.size()));
}

Minimum best_of(const FitProblem& problem, const Weighting& weighting, const std::vector<Eigen::VectorXd>& starts) {
  constexpr int kFewSteps = 12;
  const auto minimum_from = [&](const Eigen::VectorXd& start, int most) {
    return minimise(problem.rows, problem.target_um, weighting, problem.bounds, start, {most});
  };
  Minimum best;
  best.cost = kInfinite;
  for (const Eigen::VectorXd& start : starts) {
    Minimum now = minimum_from(start, kFewSteps);
    if (now.cost < best.cost) best = std::move(now);
  }
  if (std::isinf(best.cost)) {
    throw Error(
        "expected a model with finite values near its start, found none: the numbers in it or in the data are too "
        "large.");
  }
  return best.converged ? best : minimum_from(best.parameters, kMostSteps);
}

SolvedFit reweighted(const FitProblem& problem, const WeightingWithout& weighting_without, SolvedFit solved) {
  constexpr double kSame = 1e-3;
  for (int round = 0; round < kRobustRounds; ++round) {
    Weighting weighting = weighting_without(solved.discounted);
    const Eigen::VectorXd residual = weighted(weighting, residual_of(problem, solved));
    weighting.discount = tukey(residual, median_sigma(residual));
    std::vector<std::size_t> discounted = discounted_by(weighting.discount);
    const bool same = discounted == solved.discounted && solved.weighting.discount.size() > 0 &&
                      (weighting.discount - solved.weighting.discount).cwiseAbs().maxCoeff() < kSame;
    solved = {minimise(problem.rows, problem.target_um, weighting, problem.bounds, solved.minimum.parameters),
              std::move(weighting), std::move(discounted)};
    if (same) break;
  }
  return solved;
}

WhitenedFit whitened(const FitProblem& problem, const Fit& data, const SolvedFit& least_squares, bool robust) {
  const auto left_by = [&](const SolvedFit& solved) {
    return without(vector_of(residual_of(problem, solved)), solved.discounted);
  };
  const auto noise_left_by = [&](const SolvedFit& solved, const Eigen::MatrixXd& spent) {
    return noise_of(without(data.time_s, solved.discounted), left_by(solved), without(data.sigma_um, solved.discounted),
                    without(spent, solved.discounted));
  };
  WhitenedFit result{least_squares, {}, false};
  const int rounds = robust ? kRobustNoiseRounds : kNoiseRounds;
  for (int round = 0; round < rounds; ++round) {
    // In the last iteration corrected for the fitted parameters (REML).
    const Eigen::MatrixXd spent = round + 1 == rounds ? jacobian_of_free(problem, result.solved.minimum.parameters)
                                                      : Eigen::MatrixXd(problem.target_um.size(), 0);
    result.noise = noise_left_by(result.solved, spent);
    if (round == 0 && is_misfit(result.noise, data.time_s)) return {least_squares, result.noise, true};
    const WeightingWithout weighting_without = [&](const std::vector<std::size_t>& discounted) {
      return Weighting{Eigen::VectorXd::Ones(problem.target_um.size()),
                       Whitening(result.noise, data.time_s, data.sigma_um, discounted)};
    };
    SolvedFit next = result.solved;
    if (robust) {
      next = reweighted(problem, weighting_without, std::move(next));
    } else {
      next.weighting = weighting_without({});
      next.minimum = best_of(problem, next.weighting, {next.minimum.parameters});
    }
    if (rms_of(left_by(next)) > kWorseByWhitening * rms_of(left_by(result.solved))) {
      return {least_squares, noise_left_by(least_squares, spent.leftCols(0)), true};
    }
    result.solved = std::move(next);
  }
  return result;
}

Noise white_noise(const std::vector<double>& left_um, const std::vector<double>& sigma_um, std::size_t free) {
  const auto n = static_cast<double>(left_um.size());
  const double variance = rms_of(left_um) * rms_of(left_um) * n / std::max(1.0, n - static_cast<double>(free));
  const double stated = sigma_um.empty() ? 0.0 : rms_of(sigma_um);
  return {std::sqrt(std::max(0.0, variance - stated * stated)), 0.0, 0.0, 0.0};
}

}  // namespace ballbar
