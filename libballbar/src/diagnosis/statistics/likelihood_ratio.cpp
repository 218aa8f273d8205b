#include "diagnosis/statistics/likelihood_ratio.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <random>

#include "ballbar/diagnosis/statistics/thresholds.hpp"
#include "noise/memory_limit.hpp"
#include "noise/restricted_likelihood.hpp"
#include "noise/whitening.hpp"
#include "numerics/random_streams.hpp"

namespace ballbar {
namespace {

// A memory longer than this the record cannot show: what varies so slowly counts as what the model lacks.
double longest_memory_s(const LinearisedFit& linearised) {
  return (linearised.time_s.back() - linearised.time_s.front()) / 6.0;
}

Eigen::MatrixXd joined_columns(const LinearisedFit& linearised, const Eigen::MatrixXd& added) {
  Eigen::MatrixXd all(linearised.residual_um.size(), linearised.model.cols() + added.cols());
  all << linearised.model, added;
  return all;
}

std::span<const double> span_of(const Eigen::VectorXd& values) {
  return {values.data(), static_cast<std::size_t>(values.size())};
}

// Too few rows to tell a memory: white, and what is stated counts as known.
Noise most_likely_noise(const LinearisedFit& linearised, const Eigen::VectorXd& residual_um, const Noise& before) {
  if (linearised.residual_um.size() >= kFewestForNoise) {
    return noise_of(linearised.time_s, span_of(residual_um), linearised.sigma_um, {}, longest_memory_s(linearised));
  }
  if (!linearised.sigma_um.empty()) return before;
  return {residual_um.norm() / std::sqrt(static_cast<double>(residual_um.size())), 0.0, 0.0, 0.0};
}

}  // namespace

GlsFit gls_fit(const LinearisedFit& linearised, const Eigen::MatrixXd& added, const Noise& start, int rounds) {
  const Eigen::MatrixXd columns = joined_columns(linearised, added);
  GlsFit result;
  result.noise = start;
  if (columns.cols() == 0) {
    if (rounds > 0) result.noise = most_likely_noise(linearised, linearised.residual_um, start);
    result.residual_um = linearised.residual_um;
    result.log_likelihood =
        log_likelihood(result.noise, linearised.time_s, span_of(result.residual_um), linearised.sigma_um);
    return result;
  }
  for (int round = 0; round <= rounds; ++round) {
    const Whitening whitening(result.noise, linearised.time_s, linearised.sigma_um);
    const Eigen::MatrixXd x = whitened(whitening, columns);
    const Eigen::VectorXd r = whitened(whitening, linearised.residual_um);
    const Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver(x);
    const Eigen::VectorXd gains = solver.solve(r);
    result.residual_um = linearised.residual_um - columns * gains;
    if (round == rounds) {
      result.gains = gains.tail(added.cols());
      break;
    }
    result.noise = most_likely_noise(linearised, result.residual_um, result.noise);
  }
  result.log_likelihood =
      log_likelihood(result.noise, linearised.time_s, span_of(result.residual_um), linearised.sigma_um);
  return result;
}

Noise restricted_noise(const LinearisedFit& linearised, const Eigen::MatrixXd& added,
                       const Eigen::VectorXd& residual_um) {
  Noise noise;
  if (residual_um.size() >= kFewestForNoise) {
    noise = noise_of(linearised.time_s, span_of(residual_um), linearised.sigma_um, joined_columns(linearised, added),
                     longest_memory_s(linearised));
  }
  if (noise.correlated_um > 0.0) return noise;
  // White: the parameters spent widen it.
  const auto n = static_cast<double>(residual_um.size());
  const double spent = static_cast<double>(linearised.model.cols() + added.cols());
  double stated = 0.0;
  for (const double sigma : linearised.sigma_um) stated += sigma * sigma / n;
  const double variance = residual_um.squaredNorm() / std::max(1.0, n - spent);
  noise.white_um = std::sqrt(std::max(0.0, variance - stated));
  return noise;
}

std::vector<Noise> plausible_noises(const LinearisedFit& linearised, const Eigen::MatrixXd& added, const Noise& best,
                                    std::size_t count, std::uint64_t seed) {
  std::mt19937_64 random = simulation::stream_of(seed, simulation::Stream::signal, 1);
  std::vector<Noise> result;
  const Eigen::MatrixXd columns = joined_columns(linearised, added);
  if (!(best.correlated_um > 0.0)) {
    const double degrees =
        std::max(1.0, static_cast<double>(linearised.residual_um.size()) - static_cast<double>(columns.cols()));
    double stated = 0.0;
    for (const double sigma : linearised.sigma_um)
      stated += sigma * sigma / static_cast<double>(linearised.sigma_um.size());
    const double total = best.white_um * best.white_um + stated;
    for (std::size_t i = 0; i < count; ++i) {
      double chi2 = 0.0;
      for (int k = 0; k < static_cast<int>(degrees); ++k) chi2 += std::pow(simulation::normal(random), 2);
      Noise noise = best;
      noise.white_um = std::sqrt(std::max(0.0, total * degrees / std::max(chi2, 1e-3 * degrees) - stated));
      result.push_back(noise);
    }
    return result;
  }
  // Random walk in the logarithms of q and theta (Metropolis); the white part is well known and moves with q.
  Noise now = best;
  RestrictedLikelihood restricted(linearised.time_s, span_of(linearised.residual_um), linearised.sigma_um,
                                  unit_basis(columns));
  const auto log_likelihood_of = [&](const Noise& noise) {
    const Kalman::Sums sums = restricted.sums(variances_of(noise));
    return -0.5 * (sums.log_variances + sums.squares);
  };
  double level = log_likelihood_of(now);
  const std::size_t burn_in = 20, every = 3;
  for (std::size_t step = 0; result.size() < count && step < burn_in + every * count; ++step) {
    Noise next = now;
    // Along the ridge q^2 / theta = constant, where the likelihood is flat, and across it.
    const double along = 0.5 * simulation::normal(random), across = 0.08 * simulation::normal(random);
    next.correlation_time_s *= std::exp(along);
    next.correlated_um *= std::exp(0.5 * along + across);
    next.white_um *= std::exp(0.05 * simulation::normal(random));
    if (next.correlation_time_s < longest_memory_s(linearised)) {
      const double there = log_likelihood_of(next);
      if (std::log(simulation::uniform(random)) < there - level) {
        now = next;
        level = there;
      }
    }
    if (step >= burn_in && (step - burn_in) % every == 0) result.push_back(now);
  }
  return result;
}

}  // namespace ballbar
