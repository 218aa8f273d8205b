#include "ballbar/noise/noise.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "ballbar/units.hpp"
#include "noise/linear_filter.hpp"
#include "noise/restricted_likelihood.hpp"
#include "noise/whitening.hpp"
#include "numerics/nelder_mead.hpp"

namespace ballbar {
namespace {

constexpr double kFewestDegrees = 8.0;
constexpr double kWorthIt = 2.0;  // gain of ln L by two parameters
const double kLogTwoPi = std::log(2.0 * kPi);

double log_likelihood(const LinearFilter::Sums& sums, double n) {
  return -0.5 * (n * kLogTwoPi + sums.log_variances + sums.squares);
}

double log_likelihood(const LinearFilter& filter, const Noise& noise, std::span<const double> residual_um) {
  return log_likelihood(filter.sums(variances_of(noise), residual_um), static_cast<double>(residual_um.size()));
}

// Noise in unknowns that any number suits and that the likelihood depends on evenly:
//   x = ln theta,  y = ln w^2 / (q^2 (1 - a^2)), a the decay in a usual step: white against what is new of s in a step,
//   z = ln (w^2 + q^2)
struct Likelihood {
  const LinearFilter& filter;
  RestrictedLikelihood restricted;
  double degrees = 0.0;  // of freedom: n less the fitted columns
  bool stated = false;
  double shortest_s = 0.0, longest_s = 0.0;  // bounds of theta
  double mean_square = 0.0;

  Likelihood(const LinearFilter& of_times, std::span<const double> time_s, std::span<const double> residual,
             bool is_stated, const RowMajorMatrix& fitted)
      : filter(of_times),
        restricted(residual, fitted),
        degrees(static_cast<double>(residual.size()) - static_cast<double>(restricted.columns())),
        stated(is_stated) {
    if (time_s.empty()) return;
    const auto [first, last] = std::minmax_element(time_s.begin(), time_s.end());
    longest_s = *last - *first;
    shortest_s = std::max(filter.shortest_step_s() / 3.0, 1e-6 * longest_s);
    longest_s = std::max(shortest_s, longest_s);
    for (const double value : residual) mean_square += value * value / degrees;
    mean_square = std::max(mean_square, kLeastVariance_um2);
  }

  Covariance at(double x, double y, double z) const {
    const double theta_s = std::exp(std::clamp(x, std::log(shortest_s), std::log(longest_s)));
    return with_memory(std::exp(z), y, filter.usual_step_s(), theta_s);
  }

  double log_likelihood_of(const Covariance& noise) { return log_likelihood(restricted.sums(filter, noise), degrees); }

  // Without stated sigma the total variance of largest likelihood is sum(v^2 / S) / n times the one of gains `noise`.
  Covariance scaled(Covariance noise) {
    const double factor = restricted.sums(filter, noise).squares / degrees;
    return {noise.white * factor, noise.correlated * factor, noise.time_s};
  }

  double log_likelihood_scaled(const Covariance& noise) {
    const LinearFilter::Sums sum = restricted.sums(filter, noise);
    return -0.5 * (degrees * (kLogTwoPi + 1.0 + std::log(sum.squares / degrees)) + sum.log_variances);
  }
};

// How far a value is outside [low, high].
double outside(double value, double low, double high) { return std::max({0.0, low - value, value - high}); }

Covariance white(Likelihood& likelihood) {
  Covariance none{0.0, 0.0, 0.0};
  if (!likelihood.stated) return {likelihood.mean_square, 0.0, 0.0};
  const double largest = std::log(likelihood.mean_square);
  const auto cost = [&](const std::array<double, 1>& z) {
    return -likelihood.log_likelihood_of({std::exp(std::min(z[0], largest + 3.0)), 0.0, 0.0});
  };
  Minimum<1> best{{largest}, std::numeric_limits<double>::infinity()};
  for (const double down : {0.0, 1.0, 2.0, 4.0, 8.0}) {
    const double value = cost({largest - down});
    if (value < best.value) best = {{largest - down}, value};
  }
  best = nelder_mead<1>(cost, best.x, {0.5}, 1e-7, 100);
  // A white part below a thousandth of the stated one, or without benefit, is set to 0.
  if (-likelihood.log_likelihood_of(none) <= best.value + 1e-3) return none;
  return {std::exp(best.x[0]), 0.0, 0.0};
}

// Minus the likelihood of correlated noise in the unknowns x, y and, where sigma is stated, z.
struct Cost {
  static constexpr double kLeastWhite = -8.0, kMostWhite = 10.0;  // y
  Likelihood& likelihood;

  double at(const std::array<double, 3>& p) const {
    const auto [x, y, z] = p;
    const double out = outside(x, std::log(likelihood.shortest_s), std::log(likelihood.longest_s)) +
                       outside(y, kLeastWhite, kMostWhite);
    if (!likelihood.stated) return out * out - likelihood.log_likelihood_scaled(likelihood.at(x, y, 0.0));
    const double size = std::log(likelihood.mean_square), far = outside(z, size - 12.0, size + 4.0);
    return out * out + far * far - likelihood.log_likelihood_of(likelihood.at(x, y, z));
  }

  Minimum<3> down_from(const std::array<double, 3>& start) const {
    if (likelihood.stated) {
      return nelder_mead<3>([&](const auto& p) { return at(p); }, start, {0.6, 0.6, 0.3}, 1e-4, 200);
    }
    const Minimum<2> plane = nelder_mead<2>(
        [&](const auto& p) {
          return at({p[0], p[1], 0.0});
        },
        {start[0], start[1]}, {0.6, 0.6}, 1e-4, 120);
    return {{plane.x[0], plane.x[1], 0.0}, plane.value};
  }
};

// Minimises from the two best of a grid of starts.
Minimum<3> best_of_grid(Likelihood& likelihood) {
  constexpr int kTimes = 6;
  const Cost cost{likelihood};
  const double low = std::log(likelihood.shortest_s), high = std::log(likelihood.longest_s);
  const double size = std::log(likelihood.mean_square);
  const std::vector<double> sizes =
      likelihood.stated ? std::vector<double>{size - 1.5, size} : std::vector<double>{0.0};
  std::vector<Minimum<3>> starts;
  for (int i = 0; i < kTimes; ++i) {
    const double x = low + (high - low) * (i + 0.5) / kTimes;
    for (const double y : {-5.0, -1.5, 0.5, 2.5, 4.5}) {
      for (const double z : sizes) starts.push_back({{x, y, z}, cost.at({x, y, z})});
    }
  }
  std::stable_sort(starts.begin(), starts.end(), [](const auto& a, const auto& b) { return a.value < b.value; });
  const Minimum<3> first = cost.down_from(starts[0].x), second = cost.down_from(starts[1].x);
  return second.value < first.value ? second : first;
}

// Where columns were fitted, the largest of the plain likelihood, which costs less, is the start for the restricted
// one.
Covariance likeliest_memory(Likelihood& likelihood, Likelihood& plain) {
  Minimum<3> best = best_of_grid(plain);
  if (likelihood.restricted.columns() > 0) best = Cost{likelihood}.down_from(best.x);
  Covariance noise = likelihood.at(best.x[0], best.x[1], best.x[2]);
  if (!likelihood.stated) noise = likelihood.scaled(noise);
  // No white part where none is needed.
  Covariance pure{0.0, noise.white + noise.correlated, noise.time_s};
  if (!likelihood.stated) pure = likelihood.scaled(pure);
  return likelihood.log_likelihood_of(pure) >= likelihood.log_likelihood_of(noise) - 1e-3 ? pure : noise;
}

}  // namespace

Noise noise_of(std::span<const double> time_s, std::span<const double> residual_um, std::span<const double> sigma_um,
               const Eigen::MatrixXd& fitted) {
  if (residual_um.empty()) return {};
  RowMajorMatrix columns = unit_basis(fitted);
  if (static_cast<std::size_t>(columns.cols()) >= residual_um.size()) columns = RowMajorMatrix(fitted.rows(), 0);
  std::vector<double> left_um(residual_um.begin(), residual_um.end());
  if (columns.cols() > 0) {
    Eigen::Map<Eigen::VectorXd> left(left_um.data(), columns.rows());
    left -= columns * (columns.transpose() * left).eval();
  }
  const LinearFilter filter(time_s, {.variance = squares_of(sigma_um)});
  Likelihood likelihood(filter, time_s, left_um, !sigma_um.empty(), columns);
  Covariance noise = white(likelihood);
  const bool enough = likelihood.degrees >= kFewestDegrees && filter.usual_step_s() > 0.0 &&
                      likelihood.mean_square > kLeastVariance_um2;
  if (enough) {
    Likelihood plain(filter, time_s, left_um, !sigma_um.empty(), RowMajorMatrix(0, 0));
    const Covariance other = likeliest_memory(likelihood, plain);
    if (likelihood.log_likelihood_of(other) > likelihood.log_likelihood_of(noise) + kWorthIt) noise = other;
  }
  Noise result{std::sqrt(noise.white), std::sqrt(noise.correlated), noise.correlated > 0.0 ? noise.time_s : 0.0, 0.0};
  result.log_likelihood = log_likelihood(filter, result, residual_um);
  return result;
}

double log_likelihood(const Noise& noise, std::span<const double> time_s, std::span<const double> residual_um,
                      std::span<const double> sigma_um) {
  return log_likelihood(LinearFilter(time_s, {.variance = squares_of(sigma_um)}), noise, residual_um);
}

double effective_samples(const Noise& noise, std::span<const double> time_s, std::span<const double> sigma_um) {
  const std::size_t n = time_s.size();
  if (n == 0) return 0.0;
  const Whitening whitening(noise, time_s, sigma_um);
  std::vector<double> ones(n, 1.0);
  whitening.apply(ones.data(), 1, ones.data(), 1);
  double information = 0.0, inverse_variances = 0.0;
  const Covariance variances = variances_of(noise);
  for (std::size_t i = 0; i < n; ++i) {
    information += ones[i] * ones[i];
    const double stated = sigma_um.empty() ? 0.0 : sigma_um[i] * sigma_um[i];
    inverse_variances += 1.0 / std::max(variances.white + variances.correlated + stated, kLeastVariance_um2);
  }
  return information * static_cast<double>(n) / inverse_variances;
}

// n^2 var = sum_i (w^2 + sigma_i^2 + q^2) + 2 q^2 sum_(j<i) exp(-(t_i - t_j) / theta); the inner sum is a recursion.
double sigma_of_mean(const Noise& noise, std::span<const double> time_s, std::span<const double> sigma_um) {
  const std::size_t n = time_s.size();
  if (n == 0) return 0.0;
  const Covariance variances = variances_of(noise);
  double sum = 0.0, earlier = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const double stated = sigma_um.empty() ? 0.0 : sigma_um[i] * sigma_um[i];
    sum += variances.white + stated + variances.correlated;
    if (i == 0 || !(variances.correlated > 0.0)) continue;
    const double step_s = time_s[i] - time_s[i - 1];
    earlier = step_s < 0.0 ? 0.0 : (earlier + 1.0) * std::exp(-step_s / noise.correlation_time_s);
    sum += 2.0 * variances.correlated * earlier;
  }
  return std::sqrt(sum) / static_cast<double>(n);
}

}  // namespace ballbar
