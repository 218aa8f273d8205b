#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "ballbar/error.hpp"
#include "ballbar/internal/numerics/parallel.hpp"
#include "ballbar/predict/train.hpp"
#include "numerics/not_finite.hpp"
#include "numerics/root.hpp"

namespace ballbar {
namespace {

constexpr double kFarFromPlane = 4.0;  // times the largest Q in training
constexpr double kOneSensor = 0.9;     // of the odd rows: otherwise it is the job that is unlike the training
constexpr double kRounding = 1e-9;
constexpr std::size_t kFewRows = 3;  // that a sensor must spoil
constexpr double kNothing = 1e-12;   // of the largest eigenvalue: a direction in which the inputs do not move

// Eigenvalues of the inputs' scatter from the largest down, and the target along each eigenvector.
struct Principal {
  Eigen::VectorXd value;    // m
  Eigen::MatrixXd vector;   // m by m, one a column
  Eigen::VectorXd along;    // m: vector' S_xy
  Eigen::Index determined;  // eigenvalues that are more than nothing
};

Principal principal(const Moments& moments) {
  const Eigen::Index m = moments.mean.size() - 1;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(Eigen::MatrixXd(moments.scatter.topLeftCorner(m, m)));
  Principal result{solver.eigenvalues().reverse(), solver.eigenvectors().rowwise().reverse(), {}, 0};
  result.along = result.vector.transpose() * moments.scatter.col(m).head(m);
  while (result.determined < m && result.value[result.determined] > kNothing * result.value[0]) ++result.determined;
  return result;
}

void expect_possible(const Moments& moments, const RegressionSettings& settings) {
  const auto m = static_cast<std::size_t>(moments.mean.size() - 1);
  if (!(settings.penalty_K2 >= 0.0)) {
    throw Error(fmt::format("expected a penalty not below 0, found {}.", settings.penalty_K2));
  }
  if (settings.method != RegressionMethod::pcr) return;
  if (settings.components < 1 || settings.components > m) {
    throw Error(
        fmt::format("expected 1 to {} components, as many as there are inputs, found {}.", m, settings.components));
  }
}

void expect_two(std::size_t batches) {
  if (batches < 2) throw Error(fmt::format("expected at least 2 batches, to leave one out, found {}.", batches));
}

// Row by row: T2 and Q.
struct RangeStatistics {
  Eigen::MatrixXd scores;    // n by p
  Eigen::MatrixXd residual;  // n by m
  Eigen::VectorXd T2, Q_K2;  // n
};

RangeStatistics range_statistics(const TrainedRange& range, const Eigen::MatrixXd& inputs) {
  const Eigen::MatrixXd centred = inputs.rowwise() - range.mean_degC.transpose();
  RangeStatistics result;
  result.scores = centred * range.loadings;
  result.residual = centred - result.scores * range.loadings.transpose();
  const Eigen::VectorXd inverse = range.variance_K2.unaryExpr([](double d) { return d > 0.0 ? 1.0 / d : 0.0; });
  result.T2 = result.scores.cwiseAbs2() * inverse;
  result.Q_K2 = result.residual.rowwise().squaredNorm();
  return result;
}

// The largest in training; where the components draw all of the inputs Q is rounding alone.
double ordinary_Q_K2(const TrainedRange& range) {
  return std::max({range.largest_Q_K2, kRounding * range.variance_K2.sum(), kRounding});
}

// Sensors whose reading, replaced by what the others suggest, makes the row ordinary: the fall of Q is
// e_j' C_jj^-1 e_j with C = I - L L', e = C x (reconstruction-based contribution, Alcala and Qin 2009).
std::vector<std::string> broken_of(const TemperatureRegression& model, const RangeStatistics& rows) {
  const auto sensors = static_cast<Eigen::Index>(model.columns.sensors.size());
  const Eigen::Index m = model.range.mean_degC.size();
  const Eigen::MatrixXd c = Eigen::MatrixXd::Identity(m, m) - model.range.loadings * model.range.loadings.transpose();
  const double limit = kFarFromPlane * ordinary_Q_K2(model.range);
  std::size_t odd = 0;  // rows
  std::vector<std::size_t> mended(model.columns.sensors.size(), 0);
  for (Eigen::Index i = 0; i < rows.Q_K2.size(); ++i) {
    if (!(rows.Q_K2[i] > limit)) continue;
    ++odd;
    for (Eigen::Index j = 0; j < sensors; ++j) {
      std::vector<Eigen::Index> places{j};
      if (m > sensors) places.push_back(j + sensors);
      const Eigen::MatrixXd own = c(places, places);
      if (!(own.diagonal().minCoeff() > 1e-6)) continue;
      const Eigen::VectorXd e = rows.residual.row(i).transpose()(places);
      if (rows.Q_K2[i] - e.dot(own.ldlt().solve(e)) <= limit) ++mended[static_cast<std::size_t>(j)];
    }
  }
  std::vector<std::string> broken;
  if (odd < std::min(kFewRows, static_cast<std::size_t>(rows.Q_K2.size()))) return broken;
  for (std::size_t j = 0; j < mended.size(); ++j) {
    if (static_cast<double>(mended[j]) >= kOneSensor * static_cast<double>(odd)) {
      broken.push_back(model.columns.sensors[j]);
    }
  }
  return broken;
}

}  // namespace

std::string_view name_of(RegressionMethod method) { return method == RegressionMethod::pcr ? "pcr" : "ridge"; }

std::string label_of(const RegressionSettings& settings) {
  if (settings.method == RegressionMethod::ridge) return fmt::format("ridge, penalty {:.2g} K^2", settings.penalty_K2);
  return fmt::format("pcr, {} component{}", settings.components, settings.components == 1 ? "" : "s");
}

std::vector<Regression> regress(const Moments& moments, std::span<const RegressionSettings> settings) {
  const Principal p = principal(moments);
  std::vector<Regression> result;
  result.reserve(settings.size());
  for (const RegressionSettings& one : settings) {
    expect_possible(moments, one);
    const bool is_pcr = one.method == RegressionMethod::pcr;
    const Eigen::Index used =  // what else there is, is rounding
        is_pcr ? std::min(static_cast<Eigen::Index>(one.components), p.determined) : p.determined;
    const double penalty = is_pcr ? 0.0 : moments.weight * one.penalty_K2;
    const Eigen::VectorXd slope =
        p.vector.leftCols(used) * (p.along.head(used).array() / (p.value.head(used).array() + penalty)).matrix();
    result.push_back({slope, moments.mean[slope.size()] - slope.dot(moments.mean.head(slope.size()))});
  }
  return result;
}

Regression regress(const Moments& moments, const RegressionSettings& settings) {
  return regress(moments, std::span(&settings, 1)).front();
}

double rmse_um(const Moments& moments, const Regression& regression) {
  const Eigen::Index m = regression.slope_um_per_K.size();
  Eigen::VectorXd v(m + 1);
  v << -regression.slope_um_per_K, 1.0;
  const double bias = v.dot(moments.mean) - regression.intercept_um;
  return std::sqrt(std::max(0.0, v.dot(moments.scatter * v)) / moments.weight + bias * bias);
}

std::size_t components_for(const Moments& moments, double share) {
  const Principal p = principal(moments);
  const double all = p.value.sum();
  double sum = 0.0;
  std::size_t count = 0;
  while (count < static_cast<std::size_t>(p.value.size()) && (count == 0 || sum < share * all)) {
    sum += p.value[static_cast<Eigen::Index>(count++)];
  }
  return count;
}

std::vector<RegressionSettings> settings_of(RegressionMethod method, std::size_t inputs) {
  constexpr std::size_t kMost = 20;
  constexpr int kPenalties = 19;
  std::vector<RegressionSettings> settings;
  if (method == RegressionMethod::ridge) {
    for (int i = 0; i < kPenalties; ++i) settings.push_back({method, 0, std::pow(10.0, -6.0 + 0.5 * i)});
    return settings;
  }
  for (std::size_t p = 1; p <= std::min(inputs, kMost); ++p) settings.push_back({method, p, 0.0});
  return settings;
}

Eigen::MatrixXd held_out_um(std::span<const Batch> batches, std::span<const RegressionSettings> settings,
                            std::span<const double> weights) {
  const std::size_t count = batches.size();
  expect_two(count);
  // All before and all after each: nothing is taken away from a sum.
  std::vector<Moments> before(count), after(count);
  const auto weighed = [&](std::size_t k) {
    return merged(batches.subspan(k, 1), weights.empty() ? weights : weights.subspan(k, 1));
  };
  for (std::size_t k = 1; k < count; ++k) before[k] = merged(before[k - 1], weighed(k - 1));
  for (std::size_t k = count - 1; k > 0; --k) after[k - 1] = merged(after[k], weighed(k));
  Eigen::MatrixXd result(static_cast<Eigen::Index>(count), static_cast<Eigen::Index>(settings.size()));
  in_parallel(count, [&](std::size_t k) {
    const std::vector<Regression> regressions = regress(merged(before[k], after[k]), settings);
    for (std::size_t s = 0; s < settings.size(); ++s) {
      result(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(s)) = rmse_um(batches[k].moments, regressions[s]);
    }
  });
  return result;
}

RegressionSettings best_settings(std::span<const Batch> batches, RegressionMethod method) {
  expect_two(batches.size());
  const auto m = static_cast<std::size_t>(batches.front().moments.mean.size() - 1);
  const std::vector<RegressionSettings> settings = settings_of(method, m);
  Eigen::Index best = 0;
  held_out_um(batches, settings).colwise().squaredNorm().minCoeff(&best);
  return settings[static_cast<std::size_t>(best)];
}

TrainedRange range_of(const Moments& moments) {
  constexpr double kShare = 0.999;
  const Principal p = principal(moments);
  const Eigen::Index m = p.value.size(),
                     used = std::min(static_cast<Eigen::Index>(components_for(moments, kShare)), p.determined);
  TrainedRange range;
  range.mean_degC = moments.mean.head(m);
  range.loadings = p.vector.leftCols(used);
  range.variance_K2 = p.value.head(used) / moments.weight;
  range.score_low_K = range.score_high_K = Eigen::VectorXd::Zero(used);
  range.low_degC = Eigen::VectorXd::Constant(m, kInfinite);
  range.high_degC = Eigen::VectorXd::Constant(m, -kInfinite);
  return range;
}

TrainedRange widened(const TrainedRange& range, const Eigen::MatrixXd& inputs) {
  TrainedRange wider = range;
  const RangeStatistics rows = range_statistics(range, inputs);
  wider.score_low_K = range.score_low_K.cwiseMin(rows.scores.colwise().minCoeff().transpose());
  wider.score_high_K = range.score_high_K.cwiseMax(rows.scores.colwise().maxCoeff().transpose());
  wider.low_degC = range.low_degC.cwiseMin(inputs.colwise().minCoeff().transpose());
  wider.high_degC = range.high_degC.cwiseMax(inputs.colwise().maxCoeff().transpose());
  wider.largest_T2 = std::max(range.largest_T2, rows.T2.maxCoeff());
  wider.largest_Q_K2 = std::max(range.largest_Q_K2, rows.Q_K2.maxCoeff());
  return wider;
}

double half_width_95_um(std::span<const double> sigma_um, std::span<const double> weights) {
  const auto weight_of = [&](std::size_t k) { return weights.empty() ? 1.0 : weights[k]; };
  double high = 0.0, all = 0.0;
  for (std::size_t k = 0; k < sigma_um.size(); ++k) {
    if (weight_of(k) > 0.0) high = std::max(high, 2.0 * sigma_um[k]);
    all += weight_of(k);
  }
  const auto outside = [&](double width) {
    double sum = 0.0;
    for (std::size_t k = 0; k < sigma_um.size(); ++k) {
      if (sigma_um[k] > 0.0) sum += weight_of(k) * std::erfc(width / sigma_um[k] / std::sqrt(2.0));
    }
    return sum / all;
  };
  return root_between([&](double width) { return outside(width) > 0.05; }, 0.0, high).second;
}

TemperatureRegression temperature_regression(std::span<const Batch> batches, std::span<const double> weights,
                                             const BatchColumns& columns, const RegressionSettings& settings,
                                             const std::function<Series(std::size_t)>& series_of) {
  const auto count = static_cast<Eigen::Index>(batches.size());
  const Eigen::VectorXd shares = weights.empty() ? Eigen::VectorXd(Eigen::VectorXd::Ones(count))
                                                 : Eigen::VectorXd(Eigen::VectorXd::Map(weights.data(), count));
  expect_two(static_cast<std::size_t>((shares.array() > 0.0).count()));
  const Moments moments = merged(batches, weights);
  TemperatureRegression model;
  model.columns = columns;
  model.settings = settings;
  model.regression = regress(moments, settings);
  model.rmse_um = rmse_um(moments, model.regression);
  const Eigen::VectorXd held_out = held_out_um(batches, std::span(&settings, 1), weights).col(0);
  model.held_out_rmse_um = std::sqrt(held_out.cwiseAbs2().dot(shares) / shares.sum());
  model.half_width_um = half_width_95_um({held_out.data(), batches.size()}, weights);
  model.range = range_of(moments);
  for (std::size_t k = 0; k < batches.size(); ++k) {
    const auto at = static_cast<Eigen::Index>(k);
    if (!(shares[at] > 0.0)) continue;
    model.range = widened(model.range, inputs_of(series_of(k), columns));
    model.batches.push_back(
        {batches[k].name, batches[k].rows, shares[at], rmse_um(batches[k].moments, model.regression), held_out[at]});
  }
  return model;
}

double effective_batches(std::span<const double> weights) {
  double sum = 0.0, squares = 0.0;
  for (const double weight : weights) {
    sum += weight;
    squares += weight * weight;
  }
  return sum * sum / squares;
}

RegressionPrediction predict(const TemperatureRegression& model, const Series& series) {
  const Eigen::MatrixXd inputs = inputs_of(series, model.columns);
  const RangeStatistics rows = range_statistics(model.range, inputs);
  const Eigen::VectorXd um = (inputs * model.regression.slope_um_per_K).array() + model.regression.intercept_um;
  std::vector<double> weights;
  weights.reserve(model.batches.size());
  for (const TrainedBatch& batch : model.batches) weights.push_back(batch.weight);
  Eigen::VectorXd width = model.half_width_um * (1.0 + rows.T2.array() / effective_batches(weights)).sqrt();
  const Eigen::VectorXd unseen = (rows.residual * model.regression.slope_um_per_K).cwiseAbs();
  for (Eigen::Index i = 0; i < width.size(); ++i) {
    if (rows.Q_K2[i] > ordinary_Q_K2(model.range)) width[i] += unseen[i];
  }
  const Eigen::VectorXd t2 = rows.T2 / std::max(model.range.largest_T2, kRounding);
  const Eigen::VectorXd q = rows.Q_K2 / ordinary_Q_K2(model.range);
  RegressionPrediction result;
  result.predicted_um.assign(um.begin(), um.end());
  result.half_width_um.assign(width.begin(), width.end());
  result.T2_of_largest.assign(t2.begin(), t2.end());
  result.Q_of_largest.assign(q.begin(), q.end());
  const std::vector<std::string> names = input_names(model.columns);
  const auto add_outside = [&](const std::string& name, const auto& values, double low, double high) {
    const std::vector<double> copy(values.begin(), values.end());
    if (const auto outside = outside_of({name, low, high}, copy, series.time_s)) result.outside.push_back(*outside);
  };
  for (std::size_t j = 0; j < names.size(); ++j) {
    const auto at = static_cast<Eigen::Index>(j);
    add_outside(names[j], inputs.col(at), model.range.low_degC[at], model.range.high_degC[at]);
  }
  for (Eigen::Index p = 0; p < model.range.loadings.cols(); ++p) {
    add_outside(fmt::format("component {}", p + 1), rows.scores.col(p), model.range.score_low_K[p],
                model.range.score_high_K[p]);
  }
  result.broken = broken_of(model, rows);
  return result;
}

}  // namespace ballbar
