// The steps of a diagnosis, each by hand or against dense matrices.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>
#include <random>

#include "ballbar/error.hpp"
#include "diagnosis/search/best_subset.hpp"
#include "diagnosis/search/max_score_null.hpp"
#include "diagnosis/signatures/signature_library.hpp"
#include "diagnosis/statistics/cross_validation.hpp"
#include "diagnosis/statistics/gain_tests.hpp"
#include "diagnosis/statistics/gaussian_process_rival.hpp"
#include "diagnosis/statistics/likelihood_ratio.hpp"
#include "noise/whitening.hpp"
#include "numerics/parallel.hpp"
#include "series/folds.hpp"
#include "series/subsampled.hpp"

namespace ballbar {
namespace {

Series rows_of(std::size_t n, double step_s) {
  Series data;
  for (std::size_t i = 0; i < n; ++i) data.time_s.push_back(static_cast<double>(i) * step_s);
  return data;
}

Leftover leftover_with(const std::vector<double>& residual_um) {
  Leftover leftover;
  for (std::size_t i = 0; i < residual_um.size(); ++i) leftover.time_s.push_back(60.0 * static_cast<double>(i));
  leftover.residual_um = Eigen::VectorXd::Map(residual_um.data(), static_cast<Eigen::Index>(residual_um.size()));
  leftover.model = Eigen::MatrixXd::Ones(leftover.residual_um.size(), 1);
  return leftover;
}

// A bank of single columns, each a family of the effect `expansion`.
Bank bank_with(const Eigen::MatrixXd& columns) {
  Bank bank;
  bank.columns = columns;
  for (Eigen::Index k = 0; k < columns.cols(); ++k) {
    bank.families.push_back({{find_effect("expansion", Level::series), {"T" + std::to_string(k) + "_degC"}},
                             static_cast<std::size_t>(k),
                             1});
    bank.signatures.push_back({static_cast<std::size_t>(k), {0.0}, k, 1, 1.0});
  }
  return bank;
}

TEST(Thinned, keeps_every_kth_value_of_the_target_and_all_inputs) {
  Series data = rows_of(6, 10.0);
  data.columns = {{"z_um", Role::measured, {1, 3, std::nan(""), 5, 7, 9}},
                  {"T_degC", Role::structure, {1, 2, 3, 4, 5, 6}}};
  const Series found = thinned(data, "z_um", 3);
  EXPECT_EQ(found.time_s, data.time_s);
  EXPECT_EQ(found.columns[1].values, data.columns[1].values);
  const std::vector<double>& left = found.columns[0].values;
  EXPECT_EQ(left[0], 1.0);
  EXPECT_TRUE(std::isnan(left[1]));
  EXPECT_TRUE(std::isnan(left[2]));
  EXPECT_EQ(left[3], 5.0);
  EXPECT_TRUE(std::isnan(left[4]));
  EXPECT_EQ(left[5], 9.0);
  EXPECT_EQ(thinned(data, "z_um", 5).columns[0].values[1], 3.0);
}

// The model is a constant: (1, -1, 1, -1) / 2 survives whole, (1, 1, 1, 1) not at all; r = 3 (1, -1, 1, -1).
TEST(Bank, score_is_the_fall_of_chi2) {
  Eigen::MatrixXd columns(4, 2);
  columns << 2, 1, -2, 1, 2, 1, -2, 1;
  const Bank bank = bank_with(columns);
  const Eigen::VectorXd residual = (Eigen::VectorXd(4) << 3, -3, 3, -3).finished();
  const Leftover leftover = leftover_with({3, -3, 3, -3});
  const Noise noise{2.0, 0.0, 0.0, 0.0};
  const Projected seen = projected(bank, residual, Eigen::MatrixXd::Ones(4, 1), Whitening(noise, leftover.time_s, {}));
  const Eigen::VectorXd found = scores(bank, seen, seen.residual);
  EXPECT_NEAR(found[0], 36.0 / 4.0, 1e-12);
  EXPECT_NEAR(found[1], 0.0, 1e-12);
  EXPECT_NEAR(seen.share[0], 1.0, 1e-12);
  EXPECT_NEAR(seen.share[1], 0.0, 1e-12);
  EXPECT_NEAR(seen.norm[0], 4.0 / 2.0, 1e-12);
}

// One signature, white noise: scores are chi^2 with one degree of freedom; 90 % quantile 2.706, mean excess about 2.4.
TEST(SearchNull, one_signature_is_chi2) {
  const std::size_t n = 40;
  Eigen::MatrixXd columns(n, 1);
  for (Eigen::Index i = 0; i < columns.rows(); ++i) columns(i, 0) = std::sin(0.7 * static_cast<double>(i));
  const Bank bank = bank_with(columns);
  const Leftover leftover = leftover_with(std::vector<double>(n, 0.0));
  const Noise noise{0.3, 0.0, 0.0, 0.0};
  const Projected seen = projected(bank, leftover.residual_um, leftover.model, Whitening(noise, leftover.time_s, {}));
  const SearchNull null = search_null(bank, seen, leftover, noise, {noise}, 20000, 1);
  const Effect& effect = *bank.families[0].bound.effect;
  EXPECT_NEAR(null.p_of_effect(effect, 2.706), 0.1, 0.01);
  EXPECT_NEAR(null.p_of_effect(effect, 6.635), 0.01, 0.004);
  EXPECT_NEAR(null.p_search(effect, 6.635), 0.01, 0.004);
  EXPECT_GT(null.threshold(effect), 5.5);
  EXPECT_LT(null.threshold(effect), 8.0);
}

// Noise with a memory, uneven steps and stated sigma: whitened by itself it is white, whatever the filter's way.
TEST(SearchNull, noise_with_a_memory_is_drawn_as_it_is) {
  const std::size_t n = 40;
  Eigen::MatrixXd columns(n, 1);
  for (Eigen::Index i = 0; i < columns.rows(); ++i) columns(i, 0) = std::sin(0.2 * static_cast<double>(i));
  const Bank bank = bank_with(columns);
  Leftover leftover = leftover_with(std::vector<double>(n, 0.0));
  for (std::size_t i = 0; i < n; ++i) {
    leftover.time_s[i] += i % 3 == 0 ? 10.0 : 0.0;
    leftover.sigma_um.push_back(i % 2 == 0 ? 0.1 : 0.3);
  }
  const Noise noise{0.3, 0.5, 200.0, 0.0};
  const Whitening whitening(noise, leftover.time_s, leftover.sigma_um);
  const Projected seen = projected(bank, leftover.residual_um, leftover.model, whitening);
  const SearchNull null = search_null(bank, seen, leftover, noise, {noise}, 20000, 1);
  const Effect& effect = *bank.families[0].bound.effect;
  EXPECT_NEAR(null.p_of_effect(effect, 2.706), 0.1, 0.01);
  EXPECT_NEAR(null.p_of_effect(effect, 6.635), 0.01, 0.004);
  // Noise of twice the size: scores are four times as large.
  const Noise larger{0.6, 1.0, 200.0, 0.0};
  leftover.sigma_um.clear();
  const Whitening plain(noise, leftover.time_s, {});
  const Projected without = projected(bank, leftover.residual_um, leftover.model, plain);
  const SearchNull twice = search_null(bank, without, leftover, noise, {larger}, 20000, 1);
  EXPECT_NEAR(twice.p_of_effect(effect, 4.0 * 2.706), 0.1, 0.01);
}

// 19 columns, 300 rows: two groups of eight, blocks of rows, and what is left over.
TEST(Whitened, many_columns_are_each_as_alone) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  std::vector<double> time_s;
  for (int i = 0; i < 300; ++i) time_s.push_back(60.0 * i + (i % 7 == 0 ? 5.0 : 0.0));
  const Whitening whitening({0.3, 0.5, 400.0, 0.0}, time_s, {});
  const Eigen::MatrixXd columns = Eigen::MatrixXd::NullaryExpr(300, 19, [&] { return normal(random); });
  const Eigen::MatrixXd together = whitened(whitening, columns);
  for (Eigen::Index k = 0; k < columns.cols(); ++k) {
    const Eigen::MatrixXd alone = whitened(whitening, columns.col(k));
    EXPECT_LT((together.col(k) - alone).cwiseAbs().maxCoeff(), 1e-12) << k;
  }
}

TEST(InParallel, parts_inside_parts_are_all_done) {
  std::vector<std::vector<int>> done(20, std::vector<int>(30, 0));
  in_parallel(done.size(), [&](std::size_t i) { in_parallel(done[i].size(), [&](std::size_t j) { ++done[i][j]; }); });
  for (const std::vector<int>& inner : done) EXPECT_EQ(inner, std::vector<int>(30, 1));
  const auto throws = [&](std::size_t i) {
    in_parallel(3, [&](std::size_t j) {
      if (j > 0) throw Error(fmt::format("{} {}", i, j));
    });
  };
  try {
    in_parallel(4, throws);
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "0 1");
  }
}

// u1 and u2 nearly the same, r along their difference: each alone explains little, together all.
TEST(BestSubset, finds_a_pair_of_which_each_alone_is_weak) {
  const Eigen::Index n = 200;
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  Eigen::MatrixXd base(n, 3);
  for (Eigen::Index i = 0; i < n; ++i) base.row(i) << normal(random), normal(random), normal(random);
  Eigen::MatrixXd columns(n, 3);
  columns.col(0) = base.col(0) + 0.5 * base.col(1);
  columns.col(1) = base.col(0) - 0.5 * base.col(1);
  columns.col(2) = base.col(2);
  const Bank bank = bank_with(columns);
  const Eigen::VectorXd residual = columns.col(0) - columns.col(1);
  Leftover leftover = leftover_with(std::vector<double>(residual.begin(), residual.end()));
  const Noise noise{0.1, 0.0, 0.0, 0.0};
  const Projected seen = projected(bank, residual, leftover.model, Whitening(noise, leftover.time_s, {}));
  const std::vector<Subset> subsets = best_subsets(bank, seen, nullptr, 3);
  ASSERT_FALSE(subsets.empty());
  EXPECT_EQ(subsets.front().signatures, (std::vector<std::size_t>{0, 1}));
  EXPECT_NEAR(subsets.front().gain, seen.residual.squaredNorm(), 1e-6 * seen.residual.squaredNorm());
}

// Generalised least squares and its likelihood against dense matrices.
TEST(Evidence, explained_is_generalised_least_squares) {
  const std::vector<double> residual{0.3, -0.2, 0.5, 0.9, 1.4, 1.1, 1.9, 2.3};
  const Leftover leftover = leftover_with(residual);
  const Noise noise{0.2, 0.4, 120.0, 0.0};
  Eigen::MatrixXd added(8, 1);
  added << 0, 1, 2, 3, 4, 5, 6, 7;
  const Explained found = explained(leftover, added, noise, 0);
  Eigen::MatrixXd covariance(8, 8), x(8, 2);
  for (int i = 0; i < 8; ++i) {
    for (int j = 0; j < 8; ++j) {
      covariance(i, j) = 0.16 * std::exp(-60.0 * std::abs(i - j) / 120.0) + (i == j ? 0.04 : 0.0);
    }
  }
  x << leftover.model, added;
  const Eigen::MatrixXd inverse = covariance.inverse();
  const Eigen::VectorXd gains =
      (x.transpose() * inverse * x).ldlt().solve(x.transpose() * inverse * leftover.residual_um);
  EXPECT_NEAR(found.gains[0], gains[1], 1e-10);
  const Eigen::VectorXd left = leftover.residual_um - x * gains;
  const double dense =
      -0.5 * (8.0 * std::log(2.0 * M_PI) + std::log(covariance.determinant()) + left.dot(inverse * left));
  EXPECT_NEAR(found.log_likelihood, dense, 1e-9);
}

TEST(SmoothRival, likelihood_is_that_of_the_dense_covariance) {
  const std::vector<double> residual{0.3, -0.2, 0.5, 0.9, 1.4, 1.1};
  Leftover leftover = leftover_with(residual);
  leftover.time_s = {0.0, 60.0, 90.0, 200.0, 260.0, 400.0};
  const Noise noise{0.2, 0.4, 120.0, 0.0};
  const double amplitude = 0.7, length_s = 150.0;
  Eigen::MatrixXd covariance(6, 6);
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) {
      const double dt =
          std::abs(leftover.time_s[static_cast<std::size_t>(i)] - leftover.time_s[static_cast<std::size_t>(j)]);
      const double s = std::sqrt(3.0) * dt / length_s;
      covariance(i, j) =
          0.16 * std::exp(-dt / 120.0) + amplitude * amplitude * (1.0 + s) * std::exp(-s) + (i == j ? 0.04 : 0.0);
    }
  }
  const Eigen::MatrixXd inverse = covariance.inverse();
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(6);
  const double mean = ones.dot(inverse * leftover.residual_um) / ones.dot(inverse * ones);
  const Eigen::VectorXd left = leftover.residual_um - mean * ones;
  const double dense =
      -0.5 * (6.0 * std::log(2.0 * M_PI) + std::log(covariance.determinant()) + left.dot(inverse * left));
  EXPECT_NEAR(log_likelihood(leftover, noise, amplitude, length_s), dense, 1e-9);
}

// Even steps until the gains are steady, then a gap.
TEST(SmoothRival, a_gap_after_steady_steps_is_that_of_the_dense_covariance) {
  const Eigen::Index n = 160;
  Leftover leftover;
  leftover.residual_um.resize(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    leftover.time_s.push_back(60.0 * static_cast<double>(i) + (i >= 120 ? 500.0 : 0.0));
    leftover.residual_um[i] = std::sin(0.05 * static_cast<double>(i)) + 0.2 * std::cos(1.7 * static_cast<double>(i));
  }
  leftover.model = Eigen::MatrixXd(n, 0);
  const Noise noise{0.2, 0.3, 100.0, 0.0};
  Eigen::MatrixXd covariance(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      const double dt =
          std::abs(leftover.time_s[static_cast<std::size_t>(i)] - leftover.time_s[static_cast<std::size_t>(j)]);
      const double s = std::sqrt(3.0) * dt / 400.0;
      covariance(i, j) = 0.09 * std::exp(-dt / 100.0) + 0.49 * (1.0 + s) * std::exp(-s) + (i == j ? 0.04 : 0.0);
    }
  }
  const Eigen::LLT<Eigen::MatrixXd> factor(covariance);
  const double log_det = 2.0 * Eigen::MatrixXd(factor.matrixL()).diagonal().array().log().sum();
  const double dense = -0.5 * (static_cast<double>(n) * std::log(2.0 * M_PI) + log_det +
                               leftover.residual_um.dot(factor.solve(leftover.residual_um)));
  EXPECT_NEAR(log_likelihood(leftover, noise, 0.7, 400.0), dense, 1e-6);
}

// What the model makes already has no score and leads no search.
TEST(BestSubset, leaves_out_what_the_model_absorbs) {
  Eigen::MatrixXd columns(6, 2);
  columns << 1, 1, 1, -1, 1, 2, 1, -2, 1, 1, 1, 3;
  const Bank bank = bank_with(columns);
  const Leftover leftover = leftover_with({0.1, -0.2, 0.1, 0.2, -0.1, -0.1});
  const Noise noise{0.2, 0.0, 0.0, 0.0};
  const Projected seen = projected(bank, leftover.residual_um, leftover.model, Whitening(noise, leftover.time_s, {}));
  for (const Subset& subset : best_subsets(bank, seen, nullptr, 2)) {
    EXPECT_EQ(subset.signatures, std::vector<std::size_t>{1});
  }
}

TEST(Confirmation, cycles_end_with_changes_of_speed) {
  Series data = rows_of(40, 60.0);
  std::vector<double> speed(40, 0.0);
  for (std::size_t i = 10; i < 30; ++i) speed[i] = i < 20 ? 3000.0 : 6000.0;
  data.columns = {{"speed_rpm", Role::speed, speed}};
  std::vector<std::size_t> rows(40);
  for (std::size_t i = 0; i < 40; ++i) rows[i] = i;
  const std::vector<std::size_t> cycle = cycles_of(data, rows);
  for (const std::size_t change : {10, 20, 30}) {
    EXPECT_NE(cycle[change], cycle[change - 1]) << change;
    EXPECT_EQ(cycle[change], cycle[change + 1]) << change;
  }
}

// Mean of the other cycle predicts: errors 2 everywhere.
TEST(Confirmation, held_out_is_predicted_from_the_rest) {
  const Leftover leftover = leftover_with({1, 1, 1, -1, -1, -1});
  const HeldOut found = held_out(leftover, {0.5, 0.0, 0.0, 0.0}, {0, 0, 0, 1, 1, 1}, false);
  EXPECT_NEAR(found.rmse_um, 2.0, 1e-9);
  EXPECT_NEAR(found.chi2, 6.0 * 4.0 / 0.25, 1e-6);
}

// Gain +1 in one cycle and -1 in the other, sigma 1: chi^2 = 2 sum of squares about the common gain 0 = 2 * 0.5 * 20.
TEST(Confirmation, another_gain_in_every_cycle_is_seen) {
  std::vector<double> residual, same;
  Eigen::MatrixXd column(40, 1);
  for (int i = 0; i < 40; ++i) {
    column(i, 0) = i % 2 == 0 ? 1.0 : -1.0;
    residual.push_back((i < 20 ? 1.0 : -1.0) * column(i, 0));
    same.push_back(column(i, 0));
  }
  std::vector<std::size_t> cycle(40, 0);
  for (std::size_t i = 20; i < 40; ++i) cycle[i] = 1;
  const Noise noise{1.0, 0.0, 0.0, 0.0};
  EXPECT_NEAR(p_same_gain(leftover_with(residual), column, noise, cycle), std::erfc(std::sqrt(40.0 / 2.0)), 1e-11);
  EXPECT_NEAR(p_same_gain(leftover_with(same), column, noise, cycle), 1.0, 1e-9);
}

}  // namespace
}  // namespace ballbar
