// The formulas of the ridge regression against dense ones worked out another way, on a few rows.
#include "predict/ridge.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "made_runs.hpp"
#include "predict/likelihood_along_variance.hpp"

namespace ballbar {
namespace {

constexpr unsigned kSources = 1U << static_cast<unsigned>(PredictorKind::source);
constexpr unsigned kTemperatures = 1U << static_cast<unsigned>(PredictorKind::temperature);
constexpr unsigned kDifferences = 1U << static_cast<unsigned>(PredictorKind::difference);

Design design(std::size_t runs, std::size_t rows) {
  std::vector<Series> all;
  for (std::size_t r = 0; r < runs; ++r) {
    all.push_back(made::run({.rows = rows, .interval_s = 300.0}, "ridge " + std::to_string(r)));
  }
  return design_of(all, "z_um", built_in_catalogue());
}

RidgeProblem problem_of(const Design& design) {
  std::vector<std::size_t> rows(design.row.size());
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = i;
  return ridge_problem(design, rows);
}

// 0.98 exp(-|dt| / l) within a run.
Eigen::MatrixXd remembered_part(const Design& design, double length_s) {
  const auto n = static_cast<Eigen::Index>(design.row.size());
  Eigen::MatrixXd part = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
      if (design.run[a] != design.run[b]) continue;
      part(i, j) = 0.98 * std::exp(-std::abs(design.time_s[a] - design.time_s[b]) / length_s);
    }
  }
  return part;
}

// v sum over families of the mean over members of z z', z their standardised values, weighted by the standard
// deviation where they are of temperatures; and N.
Eigen::MatrixXd covariance(const Design& design, const RidgeSetting& setting) {
  const auto n = static_cast<Eigen::Index>(design.row.size());
  Eigen::MatrixXd sum = Eigen::MatrixXd::Identity(n, n);
  if (setting.length_s > 0.0) sum = 0.02 * sum + remembered_part(design, setting.length_s);
  for (const PredictorFamily& family : design.predictors.families) {
    if ((setting.kinds >> static_cast<unsigned>(family.kind) & 1U) == 0) continue;
    Eigen::MatrixXd of_family = Eigen::MatrixXd::Zero(n, n);
    double weights = 0.0;
    for (const PredictorSum& member : family.members) {
      Eigen::VectorXd z = design.values.col(static_cast<Eigen::Index>(member.plus));
      if (member.minus) z -= design.values.col(static_cast<Eigen::Index>(*member.minus));
      z.array() -= z.mean();
      const double sd = std::sqrt(z.squaredNorm() / static_cast<double>(n));
      if (!(sd > 1e-6)) continue;
      z /= sd;
      const double weight = family.kind == PredictorKind::source ? 1.0 : sd;
      of_family += weight * z * z.transpose();
      weights += weight;
    }
    if (weights > 0.0) sum += setting.variance / weights * of_family;
  }
  return sum;
}

constexpr RidgeSetting kSettings[] = {{kSources, 0.3, 0.0},
                                      {kSources | kTemperatures, 1.0, 7200.0},
                                      {kSources | kTemperatures | kDifferences, 10.0, 1800.0}};

// Gains, constant and discrepancy as the least squares of an augmented problem: every row's discrepancy d is unknown
// too,
//   (y - b - X w - d)^2 / 0.02 + w' (v P)^-1 w + d' D^-1 d,   D = 0.98 exp(-|dt| / l)
// and s^2 times the inverse of its normal matrix is the covariance. Without memory there is no d, and 1 for 0.02. The
// inverse of P costs digits: compared to 1e-6 of the largest.
TEST(ridge, gains_and_their_covariance_are_those_of_the_normal_equations) {
  const Design of = design(2, 30);
  const RidgeProblem problem = problem_of(of);
  const Eigen::Index n = problem.columns.rows();
  for (const RidgeSetting& setting : kSettings) {
    const RidgeFit fit = ridge_fit(problem, setting);
    const auto m = static_cast<Eigen::Index>(fit.used.size());
    const bool remembers = setting.length_s > 0.0;
    const Eigen::Index all = 1 + m + (remembers ? n : 0);
    Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(n, all), inverse_prior = Eigen::MatrixXd::Zero(all, all);
    rows.col(0).setOnes();
    rows.middleCols(1, m) = problem.columns(Eigen::all, fit.used);
    Eigen::MatrixXd prior = Eigen::MatrixXd::Zero(m, m);
    for (std::size_t kind = 0; kind < kPredictorKinds; ++kind) {
      if ((setting.kinds >> kind & 1U) != 0) prior += setting.variance * problem.prior[kind](fit.used, fit.used);
    }
    inverse_prior.block(1, 1, m, m) = prior.inverse();
    if (remembers) {
      rows.rightCols(n).setIdentity();
      inverse_prior.bottomRightCorner(n, n) = remembered_part(of, setting.length_s).inverse();
    }
    const double noise = remembers ? 0.02 : 1.0;
    const Eigen::MatrixXd normal = rows.transpose() * rows / noise + inverse_prior;
    const Eigen::VectorXd solved = normal.ldlt().solve(rows.transpose() * problem.target_um / noise);
    const Eigen::MatrixXd inverse = normal.ldlt().solve(Eigen::MatrixXd::Identity(all, all));
    Eigen::VectorXd expected = Eigen::VectorXd::Zero(m + 2);
    expected.head(m + 1) = solved.head(m + 1);
    Eigen::MatrixXd spread = Eigen::MatrixXd::Zero(m + 2, m + 2);
    spread.topLeftCorner(m + 1, m + 1) = inverse.topLeftCorner(m + 1, m + 1);
    if (remembers) {
      expected[m + 1] = solved[all - 1];
      spread.row(m + 1).head(m + 1) = inverse.row(all - 1).head(m + 1);
      spread.col(m + 1).head(m + 1) = inverse.col(all - 1).head(m + 1);
      spread(m + 1, m + 1) = inverse(all - 1, all - 1);
    }
    spread *= fit.sigma_um * fit.sigma_um;
    EXPECT_LT((fit.gains_um - expected).cwiseAbs().maxCoeff(), 1e-6 * expected.cwiseAbs().maxCoeff());
    const Eigen::MatrixXd found = fit.factor_um * fit.factor_um.transpose();
    EXPECT_LT((found - spread).cwiseAbs().maxCoeff(), 1e-6 * spread.cwiseAbs().maxCoeff());
  }
}

// The restricted likelihood is that of n - 1 contrasts C y, C C' = I, C 1 = 0:
//   |C K C'| = |K| q / n,   S = (C y)' (C K C')^-1 C y
TEST(ridge, the_likelihood_is_that_of_contrasts) {
  const Design of = design(2, 30);
  const RidgeProblem problem = problem_of(of);
  const Eigen::Index n = problem.columns.rows();
  const Eigen::MatrixXd orthonormal = Eigen::HouseholderQR<Eigen::MatrixXd>(Eigen::VectorXd::Ones(n)).householderQ();
  const Eigen::MatrixXd contrasts = orthonormal.rightCols(n - 1).transpose();
  for (const RidgeSetting& setting : kSettings) {
    const RidgeFit fit = ridge_fit(problem, setting);
    const Eigen::MatrixXd k = contrasts * covariance(of, setting) * contrasts.transpose();
    const Eigen::VectorXd y = contrasts * of.target_um;
    const double variance_um2 = y.dot(k.ldlt().solve(y)) / static_cast<double>(n - 1);
    const double log_det = k.ldlt().vectorD().array().log().sum();
    const double expected =
        -0.5 * static_cast<double>(n - 1) * std::log(variance_um2) - 0.5 * (log_det + std::log(static_cast<double>(n)));
    EXPECT_NEAR(fit.sigma_um, std::sqrt(variance_um2), 1e-8);
    EXPECT_NEAR(fit.log_likelihood, expected, 1e-8 * std::abs(expected));
  }
}

// One reduction gives ln L at any v, within and between runs, with a named predictor too, as the factorised K does.
TEST(ridge, the_likelihood_along_the_variance_is_that_of_each_covariance) {
  for (const std::size_t runs : {std::size_t{1}, std::size_t{3}}) {
    RidgeProblem problem = problem_of(design(runs, 40));
    for (const double named_variance : {0.0, kFreeNamed}) {
      // The last predictor, of temperatures: in none of the dictionary below.
      if (named_variance > 0.0) problem.named = {static_cast<std::size_t>(problem.columns.cols()) - 1};
      for (const RidgeSetting& setting : kSettings) {
        if (named_variance > 0.0 && setting.kinds != kSources) continue;
        Eigen::MatrixXd prior = Eigen::MatrixXd::Zero(problem.columns.cols(), problem.columns.cols());
        for (std::size_t kind = 0; kind < kPredictorKinds; ++kind) {
          if ((setting.kinds >> kind & 1U) != 0) prior += problem.prior[kind];
        }
        const LikelihoodAlongVariance along(white_products(problem, setting.length_s, named_variance),
                                            prior_root(prior));
        for (const double variance : {0.01, 1.0, 1e5}) {
          const RidgeSetting one{setting.kinds, variance, setting.length_s, named_variance};
          const double expected = ridge_fit(problem, one).log_likelihood;
          EXPECT_NEAR(along.at(variance), expected, 1e-8 * std::abs(expected));
        }
      }
    }
  }
}

// The setting chosen of one run is the likeliest of those it may have: where K is factorised, and where it is reduced.
void expect_likeliest(std::size_t rows, bool is_reduced) {
  const RidgeProblem problem = problem_of(design(1, rows));
  ASSERT_EQ(2 * problem.columns.cols() <= problem.columns.rows(), is_reduced);
  const RidgeSetting chosen = chosen_setting(problem);
  const double likeliest = ridge_fit(problem, chosen).log_likelihood;
  for (const double length_s : {0.0, 1800.0, 7200.0, 30'000.0}) {
    for (const double factor : {std::sqrt(0.1), 1.0, std::sqrt(10.0)}) {
      for (const unsigned kinds : {kSources, kTemperatures, kSources | kTemperatures, kTemperatures | kDifferences,
                                   kSources | kTemperatures | kDifferences, chosen.kinds}) {
        if (length_s != chosen.length_s && factor != 1.0) continue;  // uphill from 1 each
        if (kinds != chosen.kinds && factor != 1.0) continue;
        const RidgeSetting other{kinds, chosen.variance * factor, length_s};
        EXPECT_LE(ridge_fit(problem, other).log_likelihood, likeliest + 1e-9);
      }
    }
  }
}

TEST(ridge, no_neighbour_of_the_chosen_setting_is_likelier) {
  expect_likeliest(60, false);
  expect_likeliest(400, true);
}

// The run's rows predicted from all others: b and y by the blocks of K, with the scales of all rows.
TEST(ridge, runs_left_out_are_those_really_left_out) {
  constexpr std::size_t kRuns = 5, kRows = 14;
  const Design of = design(kRuns, kRows);
  const RidgeProblem problem = problem_of(of);
  for (const RidgeSetting& setting : kSettings) {
    const LeftOutRuns left = left_out_runs(problem, setting);
    ASSERT_EQ(left.rmse_um.size(), kRuns);
    const Eigen::MatrixXd k = covariance(of, setting);
    const double sigma_um = ridge_fit(problem, setting).sigma_um;
    for (std::size_t run = 0; run < kRuns; ++run) {
      std::vector<std::size_t> out, in;
      for (std::size_t i = 0; i < of.run.size(); ++i) (of.run[i] == run ? out : in).push_back(i);
      const Eigen::MatrixXd others = k(in, in).inverse();
      const Eigen::VectorXd ones = Eigen::VectorXd::Ones(static_cast<Eigen::Index>(in.size()));
      const Eigen::VectorXd y = of.target_um(in);
      const double q = ones.dot(others * ones), b = ones.dot(others * y) / q;
      const Eigen::MatrixXd along = k(out, in) * others;
      const Eigen::VectorXd error = of.target_um(out).array() - b - (along * (y.array() - b).matrix()).array();
      const Eigen::VectorXd of_b = 1.0 - (along * ones).array();
      const Eigen::MatrixXd spread = k(out, out) - along * k(in, out) + of_b * of_b.transpose() / q;
      EXPECT_LT((left.error_um(out) - error).cwiseAbs().maxCoeff(), 1e-8);
      const Eigen::VectorXd expected = sigma_um * spread.diagonal().cwiseSqrt();
      EXPECT_LT((left.sigma_um(out) - expected).cwiseAbs().maxCoeff(), 1e-8);
      EXPECT_NEAR(left.rmse_um[run], std::sqrt(error.squaredNorm() / static_cast<double>(kRows)), 1e-8);
    }
  }
}

// As left_out_runs of the rows of all runs but one: that one is gone.
TEST(ridge, pairs_of_runs_left_out_are_runs_left_out_without_another) {
  constexpr std::size_t kRuns = 5, kRows = 14;
  const Design of = design(kRuns, kRows);
  const RidgeProblem problem = problem_of(of);
  for (const RidgeSetting& setting : kSettings) {
    const Eigen::MatrixXd pairs = left_out_pairs_um2(problem, setting, kRuns + 1);
    const LeftOutRuns left = left_out_runs(problem, setting);
    const Eigen::MatrixXd k = covariance(of, setting);
    for (std::size_t r = 0; r < kRuns; ++r) {
      for (std::size_t s = 0; s < kRuns; ++s) {
        std::vector<std::size_t> out, in;
        for (std::size_t i = 0; i < of.run.size(); ++i) {
          if (of.run[i] == s) out.push_back(i);
          if (of.run[i] != s && of.run[i] != r) in.push_back(i);
        }
        const Eigen::MatrixXd others = k(in, in).inverse();
        const Eigen::VectorXd ones = Eigen::VectorXd::Ones(static_cast<Eigen::Index>(in.size()));
        const Eigen::VectorXd y = of.target_um(in);
        const double b = ones.dot(others * y) / ones.dot(others * ones);
        const Eigen::VectorXd along = k(out, in) * (others * (y.array() - b).matrix());
        const double square_um2 = (of.target_um(out).array() - b - along.array()).square().mean();
        const auto row = static_cast<Eigen::Index>(r), column = static_cast<Eigen::Index>(s);
        EXPECT_NEAR(pairs(row, column), square_um2, 1e-8 * (1.0 + square_um2));
      }
    }
    // The sixth run has no rows: without it each is what it is left out alone.
    for (std::size_t s = 0; s < kRuns; ++s) {
      const auto column = static_cast<Eigen::Index>(s);
      EXPECT_NEAR(pairs(static_cast<Eigen::Index>(kRuns), column), left.rmse_um[s] * left.rmse_um[s], 1e-8);
    }
    EXPECT_EQ(pairs(static_cast<Eigen::Index>(kRuns), static_cast<Eigen::Index>(kRuns)), 0.0);
  }
}

}  // namespace
}  // namespace ballbar
