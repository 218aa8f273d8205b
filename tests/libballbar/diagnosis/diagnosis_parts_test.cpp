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

LinearisedFit leftover_with(const std::vector<double>& residual_um) {
  LinearisedFit linearised;
  for (std::size_t i = 0; i < residual_um.size(); ++i) linearised.time_s.push_back(60.0 * static_cast<double>(i));
  linearised.residual_um = Eigen::VectorXd::Map(residual_um.data(), static_cast<Eigen::Index>(residual_um.size()));
  linearised.model = Eigen::MatrixXd::Ones(linearised.residual_um.size(), 1);
  return linearised;
}

// A library of single columns, each a family of the effect `expansion`.
SignatureLibrary bank_with(const Eigen::MatrixXd& columns) {
  SignatureLibrary library;
  library.columns = columns;
  for (Eigen::Index k = 0; k < columns.cols(); ++k) {
    library.families.push_back({{find_effect("expansion", Level::series), {"T" + std::to_string(k) + "_degC"}},
                                static_cast<std::size_t>(k),
                                1});
    library.signatures.push_back({static_cast<std::size_t>(k), {0.0}, k, 1, 1.0});
  }
  return library;
}

TEST(Subsampled, keeps_every_kth_value_of_the_target_and_all_inputs) {
  Series data = rows_of(6, 10.0);
  data.columns = {{"z_um", Role::measured, {1, 3, std::nan(""), 5, 7, 9}},
                  {"T_degC", Role::structure, {1, 2, 3, 4, 5, 6}}};
  const Series found = subsampled(data, "z_um", 3);
  EXPECT_EQ(found.time_s, data.time_s);
  EXPECT_EQ(found.columns[1].values, data.columns[1].values);
  const std::vector<double>& left = found.columns[0].values;
  EXPECT_EQ(left[0], 1.0);
  EXPECT_TRUE(std::isnan(left[1]));
  EXPECT_TRUE(std::isnan(left[2]));
  EXPECT_EQ(left[3], 5.0);
  EXPECT_TRUE(std::isnan(left[4]));
  EXPECT_EQ(left[5], 9.0);
  EXPECT_EQ(subsampled(data, "z_um", 5).columns[0].values[1], 3.0);
}

// The model is a constant: (1, -1, 1, -1) / 2 survives whole, (1, 1, 1, 1) not at all; r = 3 (1, -1, 1, -1).
TEST(SignatureLibrary, score_is_the_fall_of_chi2) {
  Eigen::MatrixXd columns(4, 2);
  columns << 2, 1, -2, 1, 2, 1, -2, 1;
  const SignatureLibrary library = bank_with(columns);
  const Eigen::VectorXd residual = (Eigen::VectorXd(4) << 3, -3, 3, -3).finished();
  const LinearisedFit linearised = leftover_with({3, -3, 3, -3});
  const Noise noise{2.0, 0.0, 0.0, 0.0};
  const Projected seen =
      projected(library, residual, Eigen::MatrixXd::Ones(4, 1), Whitening(noise, linearised.time_s, {}));
  const Eigen::VectorXd found = scores(library, seen, seen.residual);
  EXPECT_NEAR(found[0], 36.0 / 4.0, 1e-12);
  EXPECT_NEAR(found[1], 0.0, 1e-12);
  EXPECT_NEAR(seen.share[0], 1.0, 1e-12);
  EXPECT_NEAR(seen.share[1], 0.0, 1e-12);
  EXPECT_NEAR(seen.norm[0], 4.0 / 2.0, 1e-12);
}

// One signature, white noise: scores are chi^2 with one degree of freedom; 90 % quantile 2.706, mean excess about 2.4.
TEST(MaxScoreNull, one_signature_is_chi2) {
  const std::size_t n = 40;
  Eigen::MatrixXd columns(n, 1);
  for (Eigen::Index i = 0; i < columns.rows(); ++i) columns(i, 0) = std::sin(0.7 * static_cast<double>(i));
  const SignatureLibrary library = bank_with(columns);
  const LinearisedFit linearised = leftover_with(std::vector<double>(n, 0.0));
  const Noise noise{0.3, 0.0, 0.0, 0.0};
  const Projected seen =
      projected(library, linearised.residual_um, linearised.model, Whitening(noise, linearised.time_s, {}));
  const MaxScoreNull null = max_score_null(library, seen, linearised, noise, {noise}, 20000, 1);
  const Effect& effect = *library.families[0].bound.effect;
  EXPECT_NEAR(null.p_of_effect(effect, 2.706), 0.1, 0.01);
  EXPECT_NEAR(null.p_of_effect(effect, 6.635), 0.01, 0.004);
  EXPECT_NEAR(null.p_search(effect, 6.635), 0.01, 0.004);
  EXPECT_GT(null.threshold(effect), 5.5);
  EXPECT_LT(null.threshold(effect), 8.0);
}

// Noise with a memory, uneven steps and stated sigma: whitened by itself it is white, whatever the filter's way.
TEST(MaxScoreNull, noise_with_a_memory_is_drawn_as_it_is) {
  const std::size_t n = 40;
  Eigen::MatrixXd columns(n, 1);
  for (Eigen::Index i = 0; i < columns.rows(); ++i) columns(i, 0) = std::sin(0.2 * static_cast<double>(i));
  const SignatureLibrary library = bank_with(columns);
  LinearisedFit linearised = leftover_with(std::vector<double>(n, 0.0));
  for (std::size_t i = 0; i < n; ++i) {
    linearised.time_s[i] += i % 3 == 0 ? 10.0 : 0.0;
    linearised.sigma_um.push_back(i % 2 == 0 ? 0.1 : 0.3);
  }
  const Noise noise{0.3, 0.5, 200.0, 0.0};
  const Whitening whitening(noise, linearised.time_s, linearised.sigma_um);
  const Projected seen = projected(library, linearised.residual_um, linearised.model, whitening);
  const MaxScoreNull null = max_score_null(library, seen, linearised, noise, {noise}, 20000, 1);
  const Effect& effect = *library.families[0].bound.effect;
  EXPECT_NEAR(null.p_of_effect(effect, 2.706), 0.1, 0.01);
  EXPECT_NEAR(null.p_of_effect(effect, 6.635), 0.01, 0.004);
  // Noise of twice the size: scores are four times as large.
  const Noise larger{0.6, 1.0, 200.0, 0.0};
  linearised.sigma_um.clear();
  const Whitening plain(noise, linearised.time_s, {});
  const Projected without = projected(library, linearised.residual_um, linearised.model, plain);
  const MaxScoreNull twice = max_score_null(library, without, linearised, noise, {larger}, 20000, 1);
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
  const SignatureLibrary library = bank_with(columns);
  const Eigen::VectorXd residual = columns.col(0) - columns.col(1);
  LinearisedFit linearised = leftover_with(std::vector<double>(residual.begin(), residual.end()));
  const Noise noise{0.1, 0.0, 0.0, 0.0};
  const Projected seen = projected(library, residual, linearised.model, Whitening(noise, linearised.time_s, {}));
  const std::vector<Subset> subsets = best_subsets(library, seen, nullptr, 3);
  ASSERT_FALSE(subsets.empty());
  EXPECT_EQ(subsets.front().signatures, (std::vector<std::size_t>{0, 1}));
  EXPECT_NEAR(subsets.front().gain, seen.residual.squaredNorm(), 1e-6 * seen.residual.squaredNorm());
}

// Generalised least squares and its likelihood against dense matrices.
TEST(LikelihoodRatio, explained_is_generalised_least_squares) {
  const std::vector<double> residual{0.3, -0.2, 0.5, 0.9, 1.4, 1.1, 1.9, 2.3};
  const LinearisedFit linearised = leftover_with(residual);
  const Noise noise{0.2, 0.4, 120.0, 0.0};
  Eigen::MatrixXd added(8, 1);
  added << 0, 1, 2, 3, 4, 5, 6, 7;
  const GlsFit found = gls_fit(linearised, added, noise, 0);
  Eigen::MatrixXd covariance(8, 8), x(8, 2);
  for (int i = 0; i < 8; ++i) {
    for (int j = 0; j < 8; ++j) {
      covariance(i, j) = 0.16 * std::exp(-60.0 * std::abs(i - j) / 120.0) + (i == j ? 0.04 : 0.0);
    }
  }
  x << linearised.model, added;
  const Eigen::MatrixXd inverse = covariance.inverse();
  const Eigen::VectorXd gains =
      (x.transpose() * inverse * x).ldlt().solve(x.transpose() * inverse * linearised.residual_um);
  EXPECT_NEAR(found.gains[0], gains[1], 1e-10);
  const Eigen::VectorXd left = linearised.residual_um - x * gains;
  const double dense =
      -0.5 * (8.0 * std::log(2.0 * M_PI) + std::log(covariance.determinant()) + left.dot(inverse * left));
  EXPECT_NEAR(found.log_likelihood, dense, 1e-9);
}

TEST(GaussianProcessAlternative, likelihood_is_that_of_the_dense_covariance) {
  const std::vector<double> residual{0.3, -0.2, 0.5, 0.9, 1.4, 1.1};
  LinearisedFit linearised = leftover_with(residual);
  linearised.time_s = {0.0, 60.0, 90.0, 200.0, 260.0, 400.0};
  const Noise noise{0.2, 0.4, 120.0, 0.0};
  const double amplitude = 0.7, length_s = 150.0;
  Eigen::MatrixXd covariance(6, 6);
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) {
      const double dt =
          std::abs(linearised.time_s[static_cast<std::size_t>(i)] - linearised.time_s[static_cast<std::size_t>(j)]);
      const double s = std::sqrt(3.0) * dt / length_s;
      covariance(i, j) =
          0.16 * std::exp(-dt / 120.0) + amplitude * amplitude * (1.0 + s) * std::exp(-s) + (i == j ? 0.04 : 0.0);
    }
  }
  const Eigen::MatrixXd inverse = covariance.inverse();
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(6);
  const double mean = ones.dot(inverse * linearised.residual_um) / ones.dot(inverse * ones);
  const Eigen::VectorXd left = linearised.residual_um - mean * ones;
  const double dense =
      -0.5 * (6.0 * std::log(2.0 * M_PI) + std::log(covariance.determinant()) + left.dot(inverse * left));
  EXPECT_NEAR(log_likelihood(linearised, noise, amplitude, length_s), dense, 1e-9);
}

// Even steps until the gains are steady, then a gap.
TEST(GaussianProcessAlternative, a_gap_after_steady_steps_is_that_of_the_dense_covariance) {
  const Eigen::Index n = 160;
  LinearisedFit linearised;
  linearised.residual_um.resize(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    linearised.time_s.push_back(60.0 * static_cast<double>(i) + (i >= 120 ? 500.0 : 0.0));
    linearised.residual_um[i] = std::sin(0.05 * static_cast<double>(i)) + 0.2 * std::cos(1.7 * static_cast<double>(i));
  }
  linearised.model = Eigen::MatrixXd(n, 0);
  const Noise noise{0.2, 0.3, 100.0, 0.0};
  Eigen::MatrixXd covariance(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      const double dt =
          std::abs(linearised.time_s[static_cast<std::size_t>(i)] - linearised.time_s[static_cast<std::size_t>(j)]);
      const double s = std::sqrt(3.0) * dt / 400.0;
      covariance(i, j) = 0.09 * std::exp(-dt / 100.0) + 0.49 * (1.0 + s) * std::exp(-s) + (i == j ? 0.04 : 0.0);
    }
  }
  const Eigen::LLT<Eigen::MatrixXd> factor(covariance);
  const double log_det = 2.0 * Eigen::MatrixXd(factor.matrixL()).diagonal().array().log().sum();
  const double dense = -0.5 * (static_cast<double>(n) * std::log(2.0 * M_PI) + log_det +
                               linearised.residual_um.dot(factor.solve(linearised.residual_um)));
  EXPECT_NEAR(log_likelihood(linearised, noise, 0.7, 400.0), dense, 1e-6);
}

// What the model makes already has no score and leads no search.
TEST(BestSubset, leaves_out_what_the_model_absorbs) {
  Eigen::MatrixXd columns(6, 2);
  columns << 1, 1, 1, -1, 1, 2, 1, -2, 1, 1, 1, 3;
  const SignatureLibrary library = bank_with(columns);
  const LinearisedFit linearised = leftover_with({0.1, -0.2, 0.1, 0.2, -0.1, -0.1});
  const Noise noise{0.2, 0.0, 0.0, 0.0};
  const Projected seen =
      projected(library, linearised.residual_um, linearised.model, Whitening(noise, linearised.time_s, {}));
  for (const Subset& subset : best_subsets(library, seen, nullptr, 2)) {
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
  const std::vector<std::size_t> fold = folds_of(data, rows);
  for (const std::size_t change : {10, 20, 30}) {
    EXPECT_NE(fold[change], fold[change - 1]) << change;
    EXPECT_EQ(fold[change], fold[change + 1]) << change;
  }
}

// Mean of the other cycle predicts: errors 2 everywhere.
TEST(Confirmation, held_out_is_predicted_from_the_rest) {
  const LinearisedFit linearised = leftover_with({1, 1, 1, -1, -1, -1});
  const CrossValidation found = cross_validation(linearised, {0.5, 0.0, 0.0, 0.0}, {0, 0, 0, 1, 1, 1}, false);
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
  std::vector<std::size_t> fold(40, 0);
  for (std::size_t i = 20; i < 40; ++i) fold[i] = 1;
  const Noise noise{1.0, 0.0, 0.0, 0.0};
  EXPECT_NEAR(p_same_gain(leftover_with(residual), column, noise, fold), std::erfc(std::sqrt(40.0 / 2.0)), 1e-11);
  EXPECT_NEAR(p_same_gain(leftover_with(same), column, noise, fold), 1.0, 1e-9);
}

}  // namespace
}  // namespace ballbar
