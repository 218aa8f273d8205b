#include <algorithm>
#include <cmath>
#include <complex>
#include <unsupported/Eigen/FFT>

#include "ballbar/fit/fit.hpp"
#include "fit/inlier_rows.hpp"
#include "noise/whitening.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kFewestRows = 16, kLags = 10, kLargestFactor = 100;
constexpr double kNothing_um = 1e-9;  // rounding

std::size_t largest_prime_factor(std::size_t n) {
  std::size_t largest = 1;
  for (std::size_t factor = 2; factor * factor <= n; ++factor) {
    for (; n % factor == 0; n /= factor) largest = factor;
  }
  return std::max(largest, n);
}

// p of a Kolmogorov-Smirnov distance above d by chance, n values: Stephens' form of the limit,
// 2 sum_k (-1)^(k-1) exp(-2 k^2 x^2), x = (sqrt n + 0.12 + 0.11 / sqrt n) d.
double kolmogorov_smirnov_p(double d, double n) {
  const double x = (std::sqrt(n) + 0.12 + 0.11 / std::sqrt(n)) * d;
  if (x < 0.3) return 1.0;  // 1 - p is below 1e-5; the sum no longer converges well
  double sum = 0.0, sign = 1.0;
  for (int k = 1; k <= 100; ++k, sign = -sign) sum += sign * std::exp(-2.0 * k * k * x * x);
  return std::clamp(2.0 * sum, 0.0, 1.0);
}

std::vector<double> autocorrelation(const std::vector<double>& residual) {
  double squares = 0.0;
  for (const double r : residual) squares += r * r;
  std::vector<double> result;
  for (std::size_t lag = 1; lag <= kLags && lag < residual.size(); ++lag) {
    double sum = 0.0;
    for (std::size_t i = lag; i < residual.size(); ++i) sum += residual[i] * residual[i - lag];
    result.push_back(squares > 0.0 ? sum / squares : 0.0);
  }
  return result;
}

}  // namespace

// Of white noise the powers I_j at the frequencies j = 1 ... m below the highest are independent and exponential, so
// that C_k = sum_(j<=k) I_j / sum_j I_j, k < m, are m - 1 sorted uniform numbers.
Whiteness whiteness(const Fit& fit) {
  if (!fit.discounted.empty()) return whiteness(inliers_of(fit));
  Whiteness result{autocorrelation(fit.residual_um)};
  std::size_t n = fit.residual_um.size();
  if (n < kFewestRows) return result;
  const auto is_nothing = [](double residual_um) { return std::abs(residual_um) < kNothing_um; };
  if (std::all_of(fit.residual_um.begin(), fit.residual_um.end(), is_nothing)) return result;
  std::vector<double> white(n);
  Whitening(fit.noise, fit.time_s, fit.sigma_um).apply(fit.residual_um.data(), 1, white.data(), 1);
  while (largest_prime_factor(n) > kLargestFactor) --n;
  white.resize(n);
  std::vector<std::complex<double>> spectrum;
  Eigen::FFT<double> fft;
  fft.fwd(spectrum, white);
  const std::size_t m = (n - 1) / 2;
  double all = 0.0;
  for (std::size_t j = 1; j <= m; ++j) all += std::norm(spectrum[j]);
  if (!(all > 0.0)) return result;
  const auto count = static_cast<double>(m - 1);
  double cumulated = 0.0;
  for (std::size_t k = 1; k < m; ++k) {
    cumulated += std::norm(spectrum[k]) / all;
    const auto rank = static_cast<double>(k);
    result.periodogram_distance =
        std::max({result.periodogram_distance, rank / count - cumulated, cumulated - (rank - 1.0) / count});
  }
  result.p = kolmogorov_smirnov_p(result.periodogram_distance, count);
  return result;
}

}  // namespace ballbar
