// Noise with a memory: likelihood against the dense normal distribution, whitening, recovery, and the floor.
#include "ballbar/noise/noise.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <chrono>
#include <cmath>
#include <random>

#include "ballbar/units.hpp"
#include "noise/whitening.hpp"

namespace ballbar {
namespace {

std::vector<double> even_times(std::size_t n, double step_s) {
  std::vector<double> time_s(n);
  for (std::size_t i = 0; i < n; ++i) time_s[i] = step_s * static_cast<double>(i);
  return time_s;
}

std::vector<double> uneven_times(std::size_t n, double step_s, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::exponential_distribution<double> step(1.0 / step_s);
  std::vector<double> time_s{0.0};
  while (time_s.size() < n) time_s.push_back(time_s.back() + 0.05 * step_s + 0.95 * step(random));
  return time_s;
}

// Exact draws: s stationary from the first row.
std::vector<double> drawn(const Noise& noise, const std::vector<double>& time_s, const std::vector<double>& sigma_um,
                          std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::vector<double> values;
  double s = 0.0;
  for (std::size_t i = 0; i < time_s.size(); ++i) {
    const double a = i == 0 ? 0.0 : std::exp(-(time_s[i] - time_s[i - 1]) / std::max(noise.correlation_time_s, 1e-9));
    s = a * s + noise.correlated_um * std::sqrt(1.0 - a * a) * normal(random);
    const double stated = sigma_um.empty() ? 0.0 : sigma_um[i];
    values.push_back(s + std::hypot(noise.white_um, stated) * normal(random));
  }
  return values;
}

Eigen::MatrixXd covariance_of(const Noise& noise, const std::vector<double>& time_s, const std::vector<double>& sigma) {
  const auto n = static_cast<Eigen::Index>(time_s.size());
  Eigen::MatrixXd covariance(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
      covariance(i, j) = noise.correlated_um * noise.correlated_um *
                         std::exp(-std::abs(time_s[a] - time_s[b]) / noise.correlation_time_s);
      if (i == j) covariance(i, j) += noise.white_um * noise.white_um + (sigma.empty() ? 0.0 : sigma[a] * sigma[a]);
    }
  }
  return covariance;
}

std::vector<double> stated(std::size_t n, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> sigma(0.1, 0.9);
  std::vector<double> sigma_um(n);
  for (double& value : sigma_um) value = sigma(random);
  return sigma_um;
}

// One row: r ~ (0, w^2 + q^2 + sigma^2) = (0, 0.09 + 0.16 + 0.75 = 1): ln L = -ln(2 pi) / 2 - r^2 / 2.
TEST(Noise, likelihood_of_one_row_by_hand) {
  const std::vector<double> time_s{5.0}, residual{2.0}, sigma{std::sqrt(0.75)};
  EXPECT_NEAR(log_likelihood({0.3, 0.4, 60.0, 0.0}, time_s, residual, sigma), -0.5 * std::log(2.0 * kPi) - 2.0, 1e-14);
}

// -(n ln 2 pi + ln det C + r' C^-1 r) / 2 by Cholesky; rounding of 40 rows of sums below 100.
TEST(Noise, likelihood_is_that_of_the_dense_normal_distribution) {
  for (const Noise& noise : {Noise{0.5, 1.2, 400.0, 0.0}, Noise{0.0, 1.0, 50.0, 0.0}, Noise{0.7, 0.3, 1e5, 0.0}}) {
    for (const bool even : {false, true}) {
      for (const bool with_sigma : {false, true}) {
        const std::vector<double> time_s = even ? even_times(40, 60.0) : uneven_times(40, 60.0, 3);
        const std::vector<double> sigma = with_sigma ? stated(40, 4) : std::vector<double>{};
        const std::vector<double> residual = drawn({0.4, 0.9, 200.0, 0.0}, time_s, sigma, 5);
        const Eigen::LLT<Eigen::MatrixXd> factor(covariance_of(noise, time_s, sigma));
        const Eigen::Map<const Eigen::VectorXd> r(residual.data(), 40);
        const double log_det = 2.0 * Eigen::MatrixXd(factor.matrixL()).diagonal().array().log().sum();
        const double dense = -0.5 * (40.0 * std::log(2.0 * kPi) + log_det + r.dot(factor.solve(r)));
        EXPECT_NEAR(log_likelihood(noise, time_s, residual, sigma), dense, 1e-9);
      }
    }
  }
}

// ln L of 0 less ln L of r is |W r|^2 / 2, W row by row; many rows of one gain, and a number that no part divides. An
// offset of 30 um: the filter begins far away. Rounding of a sum of 2e4 squares.
TEST(Noise, likelihood_of_a_long_even_series_is_that_of_its_rows) {
  const std::vector<double> time_s = even_times(20003, 10.0), none(time_s.size(), 0.0);
  for (const Noise& noise : {Noise{0.2, 1.0, 4e4, 0.0}, Noise{0.0, 1.0, 50.0, 0.0}, Noise{1.0, 0.1, 3e5, 0.0},
                             Noise{0.5, 0.0, 0.0, 0.0}, Noise{0.01, 1.0, 20.0, 0.0}}) {
    std::vector<double> residual = drawn(noise, time_s, {}, 6), white(time_s.size());
    for (double& value : residual) value += 30.0;
    Whitening(noise, time_s, {}).apply(residual.data(), 1, white.data(), 1);
    const double half = 0.5 * Eigen::VectorXd::Map(white.data(), 20003).squaredNorm();
    EXPECT_NEAR(log_likelihood(noise, time_s, none, {}) - log_likelihood(noise, time_s, residual, {}), half,
                1e-10 * half);
  }
}

// W of r -> W r: W' W = C^-1, for any column, in place and with strides.
TEST(Noise, whitening_is_the_root_of_the_inverse_covariance) {
  const Noise noise{0.5, 1.2, 100.0, 0.0};
  const std::vector<double> time_s = uneven_times(20, 60.0, 6), sigma = stated(20, 7);
  const Whitening whitening(noise, time_s, sigma);
  ASSERT_EQ(whitening.size(), 20U);
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> w = Eigen::MatrixXd::Identity(20, 20);
  for (Eigen::Index column = 0; column < 20; ++column) {
    whitening.apply(w.data() + column, 20, w.data() + column, 20);
  }
  const Eigen::MatrixXd inverse = covariance_of(noise, time_s, sigma).inverse();
  EXPECT_LT((w.transpose() * w - inverse).cwiseAbs().maxCoeff(), 1e-12 * inverse.cwiseAbs().maxCoeff());
}

// What is left out is as if it were not there: the other rows' innovations are those without it; its own is on what the
// rows before tell. Block by block it is the same.
TEST(Noise, whitening_learns_nothing_from_rows_left_out) {
  const Noise noise{0.5, 1.2, 100.0, 0.0};
  const std::vector<double> time_s = uneven_times(20, 60.0, 6), sigma = stated(20, 7),
                            r = drawn(noise, time_s, sigma, 8);
  const std::vector<std::size_t> out{5, 6, 11};
  std::vector<double> whitened(20), kept_time_s, kept_sigma, kept_r;
  for (std::size_t i = 0; i < 20; ++i) {
    if (i == 5 || i == 6 || i == 11) continue;
    kept_time_s.push_back(time_s[i]);
    kept_sigma.push_back(sigma[i]);
    kept_r.push_back(r[i]);
  }
  const Whitening whitening(noise, time_s, sigma, out);
  whitening.apply(r.data(), 1, whitened.data(), 1);
  std::vector<double> expected(17);
  Whitening(noise, kept_time_s, kept_sigma).apply(kept_r.data(), 1, expected.data(), 1);
  for (std::size_t i = 0, k = 0; i < 20; ++i) {
    if (i == 5 || i == 6 || i == 11) continue;
    EXPECT_NEAR(whitened[i], expected[k++], 1e-12);
  }
  const std::vector<double> until(time_s.begin(), time_s.begin() + 6), sigma_until(sigma.begin(), sigma.begin() + 6);
  std::vector<double> sixth(6);
  Whitening(noise, until, sigma_until).apply(r.data(), 1, sixth.data(), 1);
  EXPECT_NEAR(whitened[5], sixth[5], 1e-12);

  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> block(20, 2);
  for (Eigen::Index i = 0; i < 20; ++i) block.row(i) << r[static_cast<std::size_t>(i)], 1.0;
  RowMajorMatrix state = RowMajorMatrix::Zero(3, 2);
  whitening.apply(0, block.topRows(12), state);
  whitening.apply(12, block.bottomRows(8), state);
  for (Eigen::Index i = 0; i < 20; ++i) EXPECT_NEAR(block(i, 0), whitened[static_cast<std::size_t>(i)], 1e-14);
}

TEST(Noise, whitening_white_noise_of_1_um_changes_nothing) {
  const std::vector<double> time_s = uneven_times(50, 15.0, 8);
  std::vector<double> column = drawn({1.0, 0.0, 0.0, 0.0}, time_s, {}, 9);
  const std::vector<double> before = column;
  Whitening(Noise{1.0, 0.0, 0.0, 0.0}, time_s, {}).apply(column.data(), 1, column.data(), 1);
  for (std::size_t i = 0; i < column.size(); ++i) EXPECT_NEAR(column[i], before[i], 1e-15);
}

// Lag-1 autocorrelation and variance of 20 000 whitened values: 0 and 1 within 4 / sqrt n and 4 sqrt(2 / n).
TEST(Noise, whitened_draws_are_white) {
  const Noise noise{0.4, 1.0, 300.0, 0.0};
  const std::size_t n = 20'000;
  const std::vector<double> time_s = uneven_times(n, 15.0, 10), sigma = stated(n, 11);
  std::vector<double> column = drawn(noise, time_s, sigma, 12);
  Whitening(noise, time_s, sigma).apply(column.data(), 1, column.data(), 1);
  double variance = 0.0, next = 0.0, tenth = 0.0;
  for (std::size_t i = 0; i < n; ++i) variance += column[i] * column[i] / static_cast<double>(n);
  for (std::size_t i = 10; i < n; ++i) {
    next += column[i] * column[i - 1] / static_cast<double>(n);
    tenth += column[i] * column[i - 10] / static_cast<double>(n);
  }
  EXPECT_NEAR(variance, 1.0, 4.0 * std::sqrt(2.0 / static_cast<double>(n)));
  EXPECT_NEAR(next, 0.0, 4.0 / std::sqrt(static_cast<double>(n)));
  EXPECT_NEAR(tenth, 0.0, 4.0 / std::sqrt(static_cast<double>(n)));
}

// Likelihood ratio: 2 (ln L at the estimate - ln L at the truth) is chi^2 of 3 degrees: mean 3, standard deviation
// sqrt 6; the mean of 60 within 4 of its own sigma, 0.32. And never below 0 but for the minimiser's tolerance.
void expect_recovered(const Noise& truth, const std::vector<double>& time_s, const std::vector<double>& sigma,
                      std::uint64_t seed) {
  constexpr int kSeeds = 60;
  double mean = 0.0;
  for (int i = 0; i < kSeeds; ++i) {
    const std::vector<double> residual = drawn(truth, time_s, sigma, seed + static_cast<std::uint64_t>(i));
    const Noise found = noise_of(time_s, residual, sigma);
    EXPECT_NEAR(found.log_likelihood, log_likelihood(found, time_s, residual, sigma), 1e-8);
    const double twice = 2.0 * (found.log_likelihood - log_likelihood(truth, time_s, residual, sigma));
    EXPECT_GT(twice, -1e-3) << "seed " << i;
    mean += twice / kSeeds;
  }
  EXPECT_NEAR(mean, 3.0, 4.0 * 0.32);
}

TEST(Noise, is_recovered_on_even_steps) { expect_recovered({0.4, 1.0, 150.0, 0.0}, even_times(1500, 15.0), {}, 1000); }

TEST(Noise, is_recovered_on_uneven_steps_with_stated_sigma) {
  expect_recovered({0.5, 1.0, 600.0, 0.0}, uneven_times(800, 60.0, 20), stated(800, 21), 2000);
}

// AR(1) of 0.98: theta = 15 / -ln 0.98 = 742 s. Sigma of the estimates of one run of 5000 by the Fisher information of
// an AR(1): phi +- sqrt((1 - phi^2) / n) = 0.0028, that is 14 % of theta; of the innovations' rms sqrt(1 / 2n) = 1 %.
TEST(Noise, ar1_has_no_white_part_worth_naming) {
  const std::vector<double> time_s = even_times(5000, 15.0);
  const Noise found = noise_of(time_s, drawn({0.0, 1.0, 742.47, 0.0}, time_s, {}, 22), {});
  const double phi = std::exp(-15.0 / found.correlation_time_s);
  EXPECT_NEAR(phi, 0.98, 4.0 * 0.0028);
  EXPECT_NEAR(found.correlated_um * std::sqrt(1.0 - phi * phi), std::sqrt(1.0 - 0.98 * 0.98), 4.0 * 0.002);
  EXPECT_LT(found.white_um, 0.05);
}

// White draws: a memory is claimed in some per cent of them; 8 of 100 is 3 sigma above 3.5 %.
TEST(Noise, white_noise_is_white) {
  int with_memory = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const std::vector<double> time_s = even_times(300, 15.0);
    const Noise found = noise_of(time_s, drawn({2.0, 0.0, 0.0, 0.0}, time_s, {}, 3000 + seed), {});
    with_memory += found.correlated_um > 0.0 ? 1 : 0;
    if (found.correlated_um == 0.0) {
      EXPECT_NEAR(found.white_um, 2.0, 4.0 * 2.0 / std::sqrt(600.0));
    }
  }
  EXPECT_LE(with_memory, 10);
}

// Stated 0.5 um is all there is: no white part is added in most draws, and never more than its own scatter allows.
TEST(Noise, stated_sigma_that_is_enough_leaves_nothing) {
  const std::vector<double> time_s = even_times(400, 60.0), sigma(400, 0.5);
  int none = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Noise found = noise_of(time_s, drawn({0.0, 0.0, 0.0, 0.0}, time_s, sigma, 4000 + seed), sigma);
    none += found.white_um == 0.0 && found.correlated_um == 0.0 ? 1 : 0;
    EXPECT_LT(found.white_um, 0.3);
  }
  EXPECT_GE(none, 5);
}

TEST(Noise, few_or_no_or_perfect_residuals) {
  EXPECT_EQ(noise_of({}, {}, {}).white_um, 0.0);
  const std::vector<double> time_s = even_times(4, 60.0), residual{1.0, -1.0, 1.0, -1.0};
  const Noise few = noise_of(time_s, residual, {});
  EXPECT_NEAR(few.white_um, 1.0, 1e-14);
  EXPECT_EQ(few.correlated_um, 0.0);
  const std::vector<double> zero(20, 0.0);
  const Noise perfect = noise_of(even_times(20, 60.0), zero, {});
  EXPECT_TRUE(std::isfinite(perfect.log_likelihood));
  EXPECT_LE(perfect.white_um, 1e-9);
  std::vector<double> out(20, 1.0);
  Whitening(perfect, even_times(20, 60.0), {}).apply(zero.data(), 1, out.data(), 1);
  EXPECT_EQ(out, zero);
}

// AR(1) on even steps: 1' C^-1 1 q^2 = (n - (n - 2) phi) / (1 + phi); n = 101, phi = 1/2: (101 - 49.5) / 1.5 = 34.333.
TEST(Noise, effective_samples_by_hand) {
  const double theta_s = 60.0 / std::log(2.0);
  EXPECT_NEAR(effective_samples({0.0, 3.0, theta_s, 0.0}, even_times(101, 60.0), {}), 103.0 / 3.0, 1e-9);
  EXPECT_NEAR(effective_samples({3.0, 0.0, 0.0, 0.0}, even_times(101, 60.0), {}), 101.0, 1e-9);
  EXPECT_NEAR(effective_samples({0.0, 0.0, 0.0, 0.0}, even_times(50, 60.0), stated(50, 30)), 50.0, 1e-9);
}

// Two rows, q = 2, phi = 1/2, w = 1, sigma 1 and 2: (4 + 1 + 1 + 4 + 1 + 4 + 2 * 4 / 2) / 4 = 19 / 4.
TEST(Noise, sigma_of_a_mean_by_hand) {
  const std::vector<double> time_s{0.0, 60.0}, sigma{1.0, 2.0};
  EXPECT_NEAR(sigma_of_mean({1.0, 2.0, 60.0 / std::log(2.0), 0.0}, time_s, sigma), std::sqrt(19.0) / 2.0, 1e-14);
}

TEST(Noise, sigma_of_a_mean_is_the_sum_of_the_covariance) {
  const Noise noise{0.5, 1.2, 100.0, 0.0};
  const std::vector<double> time_s = uneven_times(30, 60.0, 31), sigma = stated(30, 32);
  EXPECT_NEAR(sigma_of_mean(noise, time_s, sigma), std::sqrt(covariance_of(noise, time_s, sigma).sum()) / 30.0, 1e-13);
}

// Two columns were fitted to white residuals: their squares are of n - 2 degrees of freedom. 20 squares of 1 / 18.
TEST(Noise, restricted_to_what_a_fit_leaves_by_hand) {
  std::vector<double> residual;
  for (int i = 0; i < 20; ++i) residual.push_back(i % 2 == 0 ? 1.0 : -1.0);
  Eigen::MatrixXd fitted = Eigen::MatrixXd::Zero(20, 3);  // orthogonal to the residual; the third one is the first
  for (Eigen::Index i = 0; i < 20; ++i) {
    fitted(i, 0) = fitted(i, 2) = 7.0;
    fitted(i, 1) = static_cast<double>(i / 2);
  }
  const Noise found = noise_of(even_times(20, 60.0), residual, {}, fitted);
  EXPECT_EQ(found.correlated_um, 0.0);
  EXPECT_NEAR(found.white_um, std::sqrt(20.0 / 18.0), 1e-12);
}

// -(ln det C + ln det X' C^-1 X + r' P r) / 2, P = C^-1 - C^-1 X (X' C^-1 X)^-1 X' C^-1, dense: the estimate has more
// of it than its neighbours, and r' P r does not know what X can take.
TEST(Noise, restricted_estimate_is_the_largest_of_the_dense_one) {
  const std::vector<double> time_s = uneven_times(80, 60.0, 50);
  for (const bool with_sigma : {false, true}) {
    const std::vector<double> sigma = with_sigma ? stated(80, 51) : std::vector<double>{};
    std::vector<double> residual = drawn({0.5, 2.0, 600.0, 0.0}, time_s, sigma, 52);
    Eigen::MatrixXd fitted(80, 2);
    for (Eigen::Index i = 0; i < 80; ++i) fitted.row(i) << 1.0, time_s[static_cast<std::size_t>(i)];
    const auto restricted = [&](const Noise& noise) {
      const Eigen::MatrixXd c = covariance_of(noise, time_s, sigma);
      const Eigen::MatrixXd inverse = c.inverse(), g = fitted.transpose() * inverse * fitted;
      const Eigen::Map<const Eigen::VectorXd> r(residual.data(), 80);
      const Eigen::VectorXd right = fitted.transpose() * inverse * r;
      return -0.5 * (std::log(c.determinant()) + std::log(g.determinant()) + r.dot(inverse * r) -
                     right.dot(g.inverse() * right));
    };
    const Noise found = noise_of(time_s, residual, sigma, fitted);
    ASSERT_GT(found.correlated_um, 0.0);
    for (const double factor : {0.8, 1.25}) {
      Noise other = found;
      other.correlated_um *= factor;
      EXPECT_GT(restricted(found), restricted(other));
      other = found;
      other.correlation_time_s *= factor;
      EXPECT_GT(restricted(found), restricted(other) - 1e-4);
      other = found;
      other.white_um = other.white_um * factor + 0.05;
      EXPECT_GT(restricted(found), restricted(other) - 1e-4);
    }
    for (std::size_t i = 0; i < 80; ++i) residual[i] += 50.0 - 0.03 * time_s[i];
    EXPECT_NEAR(noise_of(time_s, residual, sigma, fitted).correlated_um, found.correlated_um,
                0.02 * found.correlated_um);
  }
}

TEST(Noise, eleven_thousand_rows_take_no_second) {
  for (const bool even : {true, false}) {
    const std::vector<double> time_s = even ? even_times(11'000, 15.0) : uneven_times(11'000, 15.0, 40);
    const std::vector<double> residual = drawn({0.3, 1.0, 2000.0, 0.0}, time_s, {}, 41);
    const auto start = std::chrono::steady_clock::now();
    const Noise found = noise_of(time_s, residual, {});
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
    RecordProperty(even ? "even_ms" : "uneven_ms", std::to_string(took.count()));
    EXPECT_GT(found.correlated_um, 0.0);
    EXPECT_LT(took.count(), 1000.0) << "the aim is 0.05 s; a machine may be busy";
  }
}

}  // namespace
}  // namespace ballbar
