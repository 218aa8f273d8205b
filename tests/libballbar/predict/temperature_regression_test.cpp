// Regressions from merged moments, against the same by dense decompositions of the stacked rows.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

#include "ballbar/error.hpp"
#include "ballbar/predict/train.hpp"
#include "made_batches.hpp"

namespace ballbar {
namespace {

using made::expect_error;

using Eigen::MatrixXd;
using Eigen::VectorXd;

struct Rows {
  MatrixXd inputs;
  VectorXd target;
};

// All but one, stacked.
Rows stacked(const std::vector<Series>& all, const BatchColumns& columns, std::size_t left_out = ~std::size_t{0}) {
  Rows rows{MatrixXd(0, static_cast<Eigen::Index>(input_names(columns).size())), {}};
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (k == left_out) continue;
    const MatrixXd inputs = inputs_of(all[k], columns);
    const Eigen::Index before = rows.inputs.rows(), n = inputs.rows();
    rows.inputs.conservativeResize(before + n, Eigen::NoChange);
    rows.target.conservativeResize(before + n);
    rows.inputs.bottomRows(n) = inputs;
    rows.target.tail(n) = VectorXd::Map(find_column(all[k], columns.target)->values.data(), n);
  }
  return rows;
}

// PCR by singular values of the rows; ridge by QR of the rows over sqrt(n k) I.
VectorXd dense_slope(MatrixXd x, VectorXd y, const RegressionSettings& settings) {
  const Eigen::Index n = x.rows(), m = x.cols(), p = static_cast<Eigen::Index>(settings.components);
  switch (settings.method) {
    case RegressionMethod::pcr: {
      const Eigen::JacobiSVD<MatrixXd> svd(x, Eigen::ComputeThinU | Eigen::ComputeThinV);
      const VectorXd along = svd.matrixU().leftCols(p).transpose() * y;
      return svd.matrixV().leftCols(p) * (along.array() / svd.singularValues().head(p).array()).matrix();
    }
    case RegressionMethod::ridge: {
      MatrixXd over(n + m, m);
      over << x, std::sqrt(static_cast<double>(n) * settings.penalty_K2) * MatrixXd::Identity(m, m);
      VectorXd target = VectorXd::Zero(n + m);
      target.head(n) = y;
      return over.colPivHouseholderQr().solve(target);
    }
  }
  return {};
}

Regression dense(const Rows& rows, const RegressionSettings& settings) {
  const VectorXd mean = rows.inputs.colwise().mean();
  const double target = rows.target.mean();
  const VectorXd slope = dense_slope(rows.inputs.rowwise() - mean.transpose(), rows.target.array() - target, settings);
  return {slope, target - slope.dot(mean)};
}

double dense_rmse_um(const Rows& rows, const Regression& regression) {
  const VectorXd error = rows.target - rows.inputs * regression.slope_um_per_K;
  return std::sqrt((error.array() - regression.intercept_um).square().mean());
}

// PCR up to what is drawn by noise; all 24 sensors' directions; penalties over the range that is tried.
const std::vector<RegressionSettings> kSettings{
    {RegressionMethod::pcr, 1, 0.0},    {RegressionMethod::pcr, 2, 0.0},   {RegressionMethod::pcr, 3, 0.0},
    {RegressionMethod::pcr, 8, 0.0},    {RegressionMethod::pcr, 24, 0.0},  {RegressionMethod::ridge, 0, 1e-6},
    {RegressionMethod::ridge, 0, 1e-2}, {RegressionMethod::ridge, 0, 1e3}, {RegressionMethod::ridge, 0, 0.0},
};

// The scatter has the squared condition of the rows, some 1e7 here: 1e-16 * 1e7 is 1e-9 of the slope's norm.
TEST(temperature_regression, is_that_of_the_stacked_rows) {
  const std::vector<Series> all = made::warm_ups(8, {}, "stacked_rows");
  for (const InputKind kind : {InputKind::temperature, InputKind::rise}) {
    const BatchColumns columns = made::columns_of(all, kind);
    const Moments moments = merged(made::batches_of(all, columns));
    const Rows rows = stacked(all, columns);
    const std::vector<Regression> found = regress(moments, kSettings);
    for (std::size_t s = 0; s < kSettings.size(); ++s) {
      const Regression expected = dense(rows, kSettings[s]);
      EXPECT_LT((found[s].slope_um_per_K - expected.slope_um_per_K).norm(), 1e-9 * expected.slope_um_per_K.norm())
          << label_of(kSettings[s]) << ", " << name_of(kind);
      EXPECT_NEAR(found[s].intercept_um, expected.intercept_um, 1e-9 * (1.0 + std::abs(expected.intercept_um)))
          << label_of(kSettings[s]) << ", " << name_of(kind);
      EXPECT_EQ(regress(moments, kSettings[s]).slope_um_per_K, found[s].slope_um_per_K);  // alone as with the rest
      // Of the error's square the scatter holds differences of numbers 1e6 times as large.
      EXPECT_NEAR(rmse_um(moments, found[s]), dense_rmse_um(rows, expected), 1e-9 * dense_rmse_um(rows, expected))
          << label_of(kSettings[s]) << ", " << name_of(kind);
    }
  }
}

// Temperatures and rises, together of twice as many columns: each batch's rises are its temperatures less a constant,
// so that directions in which only noise differs are many; PCR of few components and ridge do not hang on them.
TEST(temperature_regression, is_that_of_the_stacked_rows_with_both_inputs) {
  const std::vector<Series> all = made::warm_ups(8, {}, "stacked_rows_both");
  const BatchColumns columns = made::columns_of(all, InputKind::both);
  const Moments moments = merged(made::batches_of(all, columns));
  const Rows rows = stacked(all, columns);
  for (const RegressionSettings& settings :
       {RegressionSettings{RegressionMethod::pcr, 3, 0.0}, RegressionSettings{RegressionMethod::ridge, 0, 1e-2}}) {
    const Regression found = regress(moments, settings), expected = dense(rows, settings);
    EXPECT_LT((found.slope_um_per_K - expected.slope_um_per_K).norm(), 1e-9 * expected.slope_um_per_K.norm())
        << label_of(settings);
  }
}

Moments moments_of(const MatrixXd& rows) {
  const VectorXd mean = rows.colwise().mean();
  const MatrixXd centred = rows.rowwise() - mean.transpose();
  return {static_cast<double>(rows.rows()), mean, centred.transpose() * centred};
}

// x = 1, 2, 3 and y = 3 x + 1: S_xx = 2, S_xy = 6. Ridge of k = 1 K^2: 6 / (2 + 3) = 1.2, intercept 7 - 1.2 * 2 = 4.6;
// errors -1.8, 0, 1.8: sqrt(2 * 3.24 / 3).
TEST(temperature_regression, by_hand) {
  const Moments moments = moments_of((MatrixXd(3, 2) << 1.0, 4.0, 2.0, 7.0, 3.0, 10.0).finished());
  for (const RegressionSettings& settings :
       {RegressionSettings{RegressionMethod::pcr, 1, 0.0}, RegressionSettings{RegressionMethod::ridge, 0, 0.0}}) {
    const Regression line = regress(moments, settings);
    EXPECT_NEAR(line.slope_um_per_K[0], 3.0, 1e-14) << label_of(settings);  // rounding
    EXPECT_NEAR(line.intercept_um, 1.0, 1e-14) << label_of(settings);
    EXPECT_NEAR(rmse_um(moments, line), 0.0, 1e-7) << label_of(settings);  // root of the rounding
  }
  const Regression ridge = regress(moments, {RegressionMethod::ridge, 0, 1.0});
  EXPECT_DOUBLE_EQ(ridge.slope_um_per_K[0], 1.2);
  EXPECT_DOUBLE_EQ(ridge.intercept_um, 4.6);
  EXPECT_DOUBLE_EQ(rmse_um(moments, ridge), std::sqrt(2.0 * 1.8 * 1.8 / 3.0));
  EXPECT_DOUBLE_EQ(rmse_um(moments, {VectorXd::Constant(1, 3.0), 3.0}), 2.0);  // 2 um too much
}

// Inputs x, 2 x and a constant, y = 5 x: of all slopes that fit, (1, 2, 0) is the shortest, and lies on the one
// component. Ridge: the component has S = 5 * 2 = 10, so 10 / (10 + 3 k) of it.
TEST(temperature_regression, collinear_and_constant_inputs) {
  MatrixXd rows(3, 4);
  rows << 1.0, 2.0, 20.1, 5.0, 2.0, 4.0, 20.1, 10.0, 3.0, 6.0, 20.1, 15.0;
  const Moments moments = moments_of(rows);
  std::vector<RegressionSettings> all;
  for (const std::size_t p : {1U, 2U, 3U}) all.push_back({RegressionMethod::pcr, p, 0.0});
  for (const double k : {0.0, 1e-6, 1.0, 1e3}) all.push_back({RegressionMethod::ridge, 0, k});
  for (const RegressionSettings& settings : all) {
    const Eigen::Vector3d expected = 10.0 / (10.0 + 3.0 * settings.penalty_K2) * Eigen::Vector3d(1.0, 2.0, 0.0);
    EXPECT_LT((regress(moments, settings).slope_um_per_K - expected).norm(), 1e-12) << label_of(settings);
  }
}

TEST(temperature_regression, a_tiny_penalty_does_not_blow_up_collinear_inputs) {
  const std::vector<Series> all = made::warm_ups(3, {}, "tiny_penalty");
  std::vector<Series> twice = all;
  for (Series& series : twice) made::values_of(series, "T02_degC") = made::values_of(series, "T01_degC");
  const Moments moments = merged(made::batches_of(twice, made::columns_of(twice)));
  const VectorXd expected = regress(moments, {RegressionMethod::ridge, 0, 0.0}).slope_um_per_K;
  for (const double k : {1e-9, 1e-12, 1e-14, 1e-16, 1e-20, 1e-300}) {
    const VectorXd found = regress(moments, {RegressionMethod::ridge, 0, k}).slope_um_per_K;
    EXPECT_LT((found - expected).norm(), 1e-3 * expected.norm()) << k;
  }
}

TEST(temperature_regression, inputs_that_stand_still) {
  MatrixXd rows(3, 3);
  rows << 20.0, 30.0, 1.0, 20.0, 30.0, 2.0, 20.0, 30.0, 6.0;
  const Moments moments = moments_of(rows);
  for (const RegressionSettings& settings :
       {RegressionSettings{RegressionMethod::pcr, 2, 0.0}, RegressionSettings{RegressionMethod::ridge, 0, 0.0},
        RegressionSettings{RegressionMethod::ridge, 0, 1.0}}) {
    const Regression found = regress(moments, settings);
    EXPECT_EQ(found.slope_um_per_K, Eigen::Vector2d::Zero()) << label_of(settings);
    EXPECT_EQ(found.intercept_um, 3.0) << label_of(settings);
    EXPECT_DOUBLE_EQ(rmse_um(moments, found), std::sqrt(14.0 / 3.0)) << label_of(settings);  // 4 + 1 + 9
  }
}

// Variances 6, 3 and 1: 60, 90 and 100 %.
TEST(temperature_regression, components_for_a_share) {
  Moments moments{10.0, VectorXd::Zero(4), MatrixXd::Zero(4, 4)};
  moments.scatter.diagonal() << 3.0, 6.0, 1.0, 5.0;
  const std::vector<std::pair<double, std::size_t>> expected{{0.0, 1},  {0.59, 1}, {0.61, 2},
                                                             {0.89, 2}, {0.91, 3}, {1.0, 3}};
  for (const auto& [share, components] : expected) EXPECT_EQ(components_for(moments, share), components) << share;
  moments.scatter.setZero();
  EXPECT_EQ(components_for(moments, 0.99), 1U);
}

TEST(temperature_regression, settings_worth_trying) {
  constexpr auto kPcr = RegressionMethod::pcr;
  EXPECT_EQ(settings_of(kPcr, 3), (std::vector<RegressionSettings>{{kPcr, 1}, {kPcr, 2}, {kPcr, 3}}));
  EXPECT_EQ(settings_of(kPcr, 24).size(), 20U);
  const std::vector<RegressionSettings> ridge = settings_of(RegressionMethod::ridge, 3);
  ASSERT_EQ(ridge.size(), 19U);
  EXPECT_DOUBLE_EQ(ridge.front().penalty_K2, 1e-6);
  EXPECT_DOUBLE_EQ(ridge.back().penalty_K2, 1e3);
  EXPECT_EQ(label_of({RegressionMethod::pcr, 5}), "pcr, 5 components");
  EXPECT_EQ(label_of({RegressionMethod::pcr, 1}), "pcr, 1 component");
  EXPECT_EQ(label_of({RegressionMethod::ridge, 0, 0.01}), "ridge, penalty 0.01 K^2");
}

TEST(temperature_regression, held_out_is_an_explicit_leave_one_out) {
  const std::vector<Series> all = made::warm_ups(5, {}, "leave_one_out");
  const BatchColumns columns = made::columns_of(all);
  const std::vector<Batch> batches = made::batches_of(all, columns);
  const MatrixXd found = held_out_um(batches, kSettings);
  ASSERT_EQ(found.rows(), 5);
  for (std::size_t k = 0; k < 5; ++k) {
    const Rows others = stacked(all, columns, k), own = stacked({all[k]}, columns);
    for (std::size_t s = 0; s < kSettings.size(); ++s) {
      const double expected = dense_rmse_um(own, dense(others, kSettings[s]));
      EXPECT_NEAR(found(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(s)), expected, 1e-8 * expected)
          << "batch " << k << ", " << label_of(kSettings[s]);  // 1e-9 as of the slopes, on inputs ten times as large
    }
  }
}

TEST(temperature_regression, held_out_with_weights_of_0_and_1) {
  const std::vector<Series> all = made::warm_ups(4, {}, "held_out_weights");
  const std::vector<Batch> batches = made::batches_of(all, made::columns_of(all));
  const std::vector<Batch> used{batches[0], batches[1], batches[3]};
  const MatrixXd found = held_out_um(batches, kSettings, std::vector<double>{1.0, 1.0, 0.0, 1.0});
  const MatrixXd expected = held_out_um(used, kSettings);
  EXPECT_EQ(found.row(0), expected.row(0));
  EXPECT_EQ(found.row(1), expected.row(1));
  EXPECT_EQ(found.row(3), expected.row(2));
  const Moments others = merged(used);
  for (std::size_t s = 0; s < kSettings.size(); ++s) {  // the one without weight: predicted by all others
    const double um = rmse_um(batches[2].moments, regress(others, kSettings[s]));
    EXPECT_NEAR(found(2, static_cast<Eigen::Index>(s)), um, 1e-8 * um) << label_of(kSettings[s]);
  }
}

TEST(temperature_regression, the_best_settings_have_the_least_error_held_out) {
  const std::vector<Series> all = made::warm_ups(6, {}, "choice_by_held_out");
  const std::vector<Batch> batches = made::batches_of(all, made::columns_of(all));
  for (const RegressionMethod method : kRegressionMethods) {
    const auto error_of = [&](const RegressionSettings& settings) {
      return held_out_um(batches, std::span(&settings, 1)).norm();
    };
    const double least = error_of(best_settings(batches, method));
    for (const RegressionSettings& settings : settings_of(method, 24)) {
      EXPECT_GE(error_of(settings), (1.0 - 1e-9) * least) << label_of(settings);
    }
  }
}

TEST(temperature_regression, messages) {
  const std::vector<Series> all = made::warm_ups(2, {}, "messages");
  const BatchColumns columns = made::columns_of(all);
  const std::vector<Batch> batches = made::batches_of(all, columns);
  const auto components = [&](std::size_t p) {
    return [=, &batches] { (void)regress(batches[0].moments, {RegressionMethod::pcr, p, 0.0}); };
  };
  expect_error("expected 1 to 24 components, as many as there are inputs, found 25.", components(25));
  expect_error("expected 1 to 24 components, as many as there are inputs, found 0.", components(0));
  const std::string few = "expected at least 2 batches, to leave one out, found 1.";
  const std::span<const Batch> one(batches.data(), 1);
  expect_error(few, [&] { (void)held_out_um(one, kSettings); });
  expect_error(few, [&] { (void)best_settings(one, RegressionMethod::pcr); });
  const auto train = [&](std::vector<double> weights) {
    (void)temperature_regression(batches, weights, columns, {RegressionMethod::pcr, 3, 0.0},
                                 [&](std::size_t k) { return all[k]; });
  };
  expect_error(few, [&] { train({0.0, 1.0}); });
  const std::string none = "expected at least 2 batches, to leave one out, found 0.";
  expect_error(none, [&] { (void)held_out_um({}, kSettings); });
  TemperatureRegression model;
  model.columns = columns;
  Series job = all[0];
  job.columns.erase(job.columns.begin() + 1);
  expect_error("expected a column T02_degC, found none; the nearest is T01_degC.", [&] { (void)predict(model, job); });
  job = all[0];
  job.columns[1].values[2] = std::numeric_limits<double>::quiet_NaN();
  expect_error("expected a value in every row of T02_degC, found a gap at 60 s.", [&] { (void)predict(model, job); });
}

TEST(temperature_regression, no_batch_at_all_is_told) {
  const std::string none = "expected at least 2 batches, to leave one out, found 0.";
  const std::vector<Series> all = made::warm_ups(2, {}, "no_batch");
  const BatchColumns columns = made::columns_of(all);
  const std::vector<Batch> batches = made::batches_of(all, columns);
  expect_error(none, [&] {
    (void)temperature_regression(batches, std::vector{0.0, 0.0}, columns, {RegressionMethod::pcr, 3, 0.0},
                                 [&](std::size_t k) { return all[k]; });
  });
  expect_error(none, [&] { (void)best_settings({}, RegressionMethod::pcr); });
}

// 1.95996 sigma hold 95 % of a normal distribution, 1.64485 sigma 90 %: with half of all exactly 0 that is 95 % again.
TEST(temperature_regression, half_width_of_95_percent) {
  constexpr double k95 = 1.959963984540054, k90 = 1.6448536269514722;
  EXPECT_NEAR(half_width_95_um(std::vector{3.0}), 3.0 * k95, 1e-12);  // bisected to the last bits
  EXPECT_NEAR(half_width_95_um(std::vector{3.0, 3.0, 3.0}), 3.0 * k95, 1e-12);
  EXPECT_NEAR(half_width_95_um(std::vector{3.0, 9.0}, std::vector{1.0, 0.0}), 3.0 * k95, 1e-12);
  EXPECT_NEAR(half_width_95_um(std::vector{0.0, 2.0}), 2.0 * k90, 1e-12);
  EXPECT_NEAR(half_width_95_um(std::vector{0.0, 2.0, 7.0}, std::vector{2.0, 2.0, 0.0}), 2.0 * k90, 1e-12);
  EXPECT_EQ(half_width_95_um(std::vector{0.0, 0.0}), 0.0);
}

struct World {
  std::vector<Series> all;
  TemperatureRegression model;
};

World world(const std::string& seed, InputKind kind, const std::vector<double>& weights = {}) {
  World result{made::warm_ups(8, {}, seed), {}};
  const BatchColumns columns = made::columns_of(result.all, kind);
  result.model = temperature_regression(made::batches_of(result.all, columns), weights, columns,
                                        {RegressionMethod::pcr, 3, 0.0}, [&](std::size_t k) { return result.all[k]; });
  return result;
}

TEST(temperature_regression, trained_model) {
  const std::vector<double> weights{1.0, 0.5, 0.0, 2.0, 1.0, 1.0, 1.0, 1.0};
  const std::vector<Series> all = made::warm_ups(8, {}, "trained_model");
  const BatchColumns columns = made::columns_of(all);
  const std::vector<Batch> batches = made::batches_of(all, columns);
  const RegressionSettings settings{RegressionMethod::pcr, 3, 0.0};
  std::vector<std::size_t> asked;
  const TemperatureRegression model = temperature_regression(batches, weights, columns, settings, [&](std::size_t k) {
    asked.push_back(k);
    return all[k];
  });
  EXPECT_EQ(asked, (std::vector<std::size_t>{0, 1, 3, 4, 5, 6, 7}));
  EXPECT_EQ(model.columns, columns);
  EXPECT_EQ(model.settings, settings);
  const Moments moments = merged(batches, weights);
  EXPECT_EQ(model.regression.slope_um_per_K, regress(moments, settings).slope_um_per_K);
  EXPECT_EQ(model.rmse_um, rmse_um(moments, model.regression));
  const MatrixXd held_out = held_out_um(batches, std::span(&settings, 1), weights);
  double square = 0.0;
  std::vector<double> sigma, used;
  ASSERT_EQ(model.batches.size(), 7U);
  for (std::size_t i = 0; i < 7; ++i) {
    const std::size_t k = asked[i];
    const TrainedBatch& batch = model.batches[i];
    EXPECT_EQ(batch.name, batches[k].name);
    EXPECT_EQ(batch.rows, 120U);
    EXPECT_EQ(batch.weight, weights[k]);
    EXPECT_EQ(batch.rmse_um, rmse_um(batches[k].moments, model.regression));
    EXPECT_EQ(batch.held_out_um, held_out(static_cast<Eigen::Index>(k), 0));
    square += weights[k] * batch.held_out_um * batch.held_out_um / 7.5;
    sigma.push_back(batch.held_out_um);
    used.push_back(weights[k]);
  }
  EXPECT_NEAR(model.held_out_rmse_um, std::sqrt(square), 1e-12);
  EXPECT_EQ(model.half_width_um, half_width_95_um(sigma, used));
}

// Rows beyond by rounding alone: 1e-9 of a range of some 10 K.
TEST(temperature_regression, the_trained_range_holds_all_training_rows) {
  for (const InputKind kind : {InputKind::temperature, InputKind::rise, InputKind::both}) {
    const World made = world("trained_range", kind);
    const TrainedRange& range = made.model.range;
    double t2 = 0.0, q = 0.0;
    VectorXd low = VectorXd::Constant(range.low_degC.size(), 1e9), high = -low;
    for (const Series& series : made.all) {
      const RegressionPrediction prediction = predict(made.model, series);
      EXPECT_TRUE(prediction.outside.empty());
      EXPECT_TRUE(prediction.broken.empty());
      t2 = std::max(t2, *std::max_element(prediction.T2_of_largest.begin(), prediction.T2_of_largest.end()));
      q = std::max(q, *std::max_element(prediction.Q_of_largest.begin(), prediction.Q_of_largest.end()));
      const MatrixXd inputs = inputs_of(series, made.model.columns);
      low = low.cwiseMin(inputs.colwise().minCoeff().transpose());
      high = high.cwiseMax(inputs.colwise().maxCoeff().transpose());
      const MatrixXd scores = (inputs.rowwise() - range.mean_degC.transpose()) * range.loadings;
      EXPECT_TRUE((scores.colwise().minCoeff().transpose().array() >= range.score_low_K.array() - 1e-9).all());
      EXPECT_TRUE((scores.colwise().maxCoeff().transpose().array() <= range.score_high_K.array() + 1e-9).all());
    }
    EXPECT_EQ(range.low_degC, low);
    EXPECT_EQ(range.high_degC, high);
    EXPECT_EQ(t2, 1.0);
    EXPECT_EQ(q, 1.0);
  }
}

// Two inputs, one component along the first, of variance 4 K^2. The row (24, 31): score 4, T2 = 16 / 4 = 4, Q = 1;
// 0.5 * 24 - 10 = 2 um. Weights 1, 1, 2: 16 / 6 batches, so 2 um * sqrt(1 + 4 * 6 / 16).
TEST(temperature_regression, prediction_by_hand) {
  TemperatureRegression model;
  model.columns = {{"T_a_degC", "T_room_degC"}, InputKind::temperature, "z_um", "T_room_degC", {}};
  model.regression = {Eigen::Vector2d(0.5, 0.0), -10.0};
  model.range = {Eigen::Vector2d(20.0, 30.0),
                 Eigen::Vector2d(1.0, 0.0),
                 VectorXd::Constant(1, 4.0),
                 VectorXd::Constant(1, -6.0),
                 VectorXd::Constant(1, 4.0),
                 Eigen::Vector2d(14.0, 28.0),
                 Eigen::Vector2d(24.0, 32.0),
                 8.0,
                 4.0};
  model.half_width_um = 2.0;
  model.batches = {{"a", 3, 1.0}, {"b", 3, 1.0}, {"c", 3, 2.0}};
  const Series job{{0.0, 60.0, 120.0, 180.0},
                   {{"T_room_degC", Role::structure, {31.0, 30.0, 30.0, 30.0}},
                    {"T_a_degC", Role::structure, {24.0, 25.0, 25.5, 26.0}}},
                   std::nullopt};
  const RegressionPrediction found = predict(model, job);
  EXPECT_EQ(found.predicted_um, (std::vector<double>{2.0, 2.5, 2.75, 3.0}));
  EXPECT_DOUBLE_EQ(found.half_width_um[0], 2.0 * std::sqrt(2.5));
  EXPECT_DOUBLE_EQ(found.T2_of_largest[0], 0.5);
  EXPECT_DOUBLE_EQ(found.Q_of_largest[0], 0.25);
  // 25 is beyond 24 by a tenth of the range of 10, not by more.
  ASSERT_EQ(found.outside.size(), 2U);
  const std::vector<std::string> what{"T_a_degC", "component 1"};
  const std::vector<double> value{26.0, 6.0}, low{14.0, -6.0}, high{24.0, 4.0};
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(found.outside[i].what, what[i]);
    EXPECT_EQ(found.outside[i].value, value[i]);
    EXPECT_EQ(found.outside[i].low, low[i]);
    EXPECT_EQ(found.outside[i].high, high[i]);
    EXPECT_EQ(found.outside[i].time_s, 120.0);
    EXPECT_EQ(found.outside[i].rows, 2U);
  }
  EXPECT_TRUE(found.broken.empty());
}

TEST(temperature_regression, a_row_beyond_the_trained_range_is_told) {
  const World made = world("beyond", InputKind::both);
  Series job = made.all[2];
  const double low = made.model.range.low_degC[4], high = made.model.range.high_degC[4];
  std::vector<double>& degC = made::values_of(job, "T05_degC");
  degC[17] = low - 0.3 * (high - low);
  degC[19] = low - 0.5 * (high - low);
  degC[20] = low - 0.05 * (high - low);  // within a tenth
  const RegressionPrediction found = predict(made.model, job);
  ASSERT_FALSE(found.outside.empty());
  EXPECT_EQ(found.outside[0].what, "T05_degC");
  EXPECT_EQ(found.outside[0].value, degC[19]);
  EXPECT_EQ(found.outside[0].low, low);
  EXPECT_EQ(found.outside[0].high, high);
  EXPECT_EQ(found.outside[0].time_s, 510.0);  // row 17 of 30 s
  EXPECT_EQ(found.outside[0].rows, 2U);
}

// Each sensor in its turn reads 30 K too much from row 40 on: of a rise that is all there is to see, what is off from
// the start has none.
TEST(temperature_regression, a_broken_sensor_is_named_and_no_other) {
  for (const InputKind kind : {InputKind::temperature, InputKind::rise, InputKind::both}) {
    const World made = world("broken", kind);
    std::mt19937_64 random(made::seed_of("broken job"));
    const Series honest = made::warm_up({}, 21.0, 25.0, 0.8, random);
    EXPECT_TRUE(predict(made.model, honest).broken.empty()) << name_of(kind);
    for (const std::string& sensor : made.model.columns.sensors) {
      Series job = honest;
      std::vector<double>& degC = made::values_of(job, sensor);
      for (std::size_t i = 40; i < degC.size(); ++i) degC[i] += 30.0;
      EXPECT_EQ(predict(made.model, job).broken, std::vector{sensor}) << name_of(kind);
      if (kind == InputKind::rise) continue;
      for (std::size_t i = 0; i < 40; ++i) degC[i] += 30.0;
      EXPECT_EQ(predict(made.model, job).broken, std::vector{sensor}) << name_of(kind) << ", all rows";
    }
  }
}

// Two sensors that are told apart by nothing left over: all that Q holds is rounding.
TEST(temperature_regression, what_no_component_leaves_over_is_never_outside) {
  std::vector<Series> all;
  std::mt19937_64 random(made::seed_of("nothing_left_over"));
  std::normal_distribution<double> normal;
  for (std::size_t k = 0; k < 3; ++k) {
    Series series{{}, {{"T_a_degC"}, {"T_room_degC"}, {"z_um", Role::measured}}, {}};
    for (std::size_t i = 0; i < 50; ++i) {
      series.time_s.push_back(static_cast<double>(i));
      for (Column& column : series.columns) column.values.push_back(20.0 + normal(random));
    }
    all.push_back(std::move(series));
  }
  for (const std::size_t sensors : {2U, 1U}) {
    if (sensors == 1) {
      for (Series& series : all) series.columns.erase(series.columns.begin());
    }
    const BatchColumns columns = made::columns_of(all);
    const TemperatureRegression model =
        temperature_regression(made::batches_of(all, columns), {}, columns, {RegressionMethod::pcr, 1, 0.0},
                               [&](std::size_t k) { return all[k]; });
    Series job = all[0];
    for (std::size_t j = 0; j < columns.sensors.size(); ++j) {
      for (double& degC : job.columns[j].values) degC += 0.37 * static_cast<double>(j + 1);
    }
    const std::vector<double> q = predict(model, job).Q_of_largest;
    EXPECT_TRUE(std::all_of(q.begin(), q.end(), [](double one) { return one >= 0.0 && one <= 1.0; }))
        << columns.sensors.size() << " sensors";  // NaN is neither
  }
}

TEST(temperature_regression, prediction_from_inputs_that_stand_still_is_their_mean) {
  std::vector<Series> all = made::warm_ups(3, {}, "stand_still");
  for (Series& series : all) {
    for (std::size_t j = 0; j < 24; ++j) series.columns[j].values.assign(120, 20.5);
  }
  const BatchColumns columns = made::columns_of(all);
  const TemperatureRegression model =
      temperature_regression(made::batches_of(all, columns), {}, columns, {RegressionMethod::pcr, 1, 0.0},
                             [&](std::size_t k) { return all[k]; });
  const RegressionPrediction found = predict(model, all[0]);
  EXPECT_NEAR(found.predicted_um[0], merged(made::batches_of(all, columns)).mean[24], 1e-12);
  EXPECT_EQ(found.half_width_um[0], model.half_width_um);
  EXPECT_FALSE(std::isnan(found.T2_of_largest[0]));
  EXPECT_FALSE(std::isnan(found.Q_of_largest[0]));
}

}  // namespace
}  // namespace ballbar
