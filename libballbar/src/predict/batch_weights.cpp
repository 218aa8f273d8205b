#include "ballbar/internal/predict/batch_weights.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "ballbar/error.hpp"
#include "ballbar/internal/numerics/order_statistic.hpp"
#include "ballbar/internal/numerics/parallel.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kLike = 30;  // batches that stand for the job
constexpr std::array kBandwidths{0.5, 0.75, 1.0, 1.5, 2.0, 3.0, std::numeric_limits<double>::infinity()};
constexpr double kLeastWeight = 0.05;      // of the largest
constexpr std::size_t kFewestWeighed = 3;  // batches
constexpr Eigen::Index kFeatures = 4;

// Features by which batches are near each other; NaN: a speed that is not logged.
Eigen::Vector4d features_of(const BatchStart& start) {
  return {start.room_first_degC, start.sensors_mean_degC, start.sensors_spread_K, start.speed_mean_rpm};
}

// 1 / s of each feature; 0 where all batches are alike.
Eigen::Vector4d scales_of(std::span<const Batch> batches) {
  Eigen::Matrix<double, Eigen::Dynamic, kFeatures> all(static_cast<Eigen::Index>(batches.size()), kFeatures);
  for (std::size_t k = 0; k < batches.size(); ++k) {
    all.row(static_cast<Eigen::Index>(k)) = features_of(batches[k].start).transpose();
  }
  const Eigen::Vector4d variance =
      (all.rowwise() - all.colwise().mean()).colwise().squaredNorm() / static_cast<double>(batches.size() - 1);
  return variance.unaryExpr([](double v) { return v > 0.0 ? 1.0 / std::sqrt(v) : 0.0; });
}

double distance(const BatchStart& a, const BatchStart& b, const Eigen::Vector4d& scales) {
  const Eigen::Vector4d apart = (features_of(a) - features_of(b)).cwiseProduct(scales);
  return apart.unaryExpr([](double one) { return std::isfinite(one) ? one : 0.0; }).norm();
}

// w_k, relative to the largest. The batch `left_out` has 0. Below kLeastWeight all but the nearest few have 0.
std::vector<double> weights_at(std::span<const Batch> batches, const BatchStart& job, double bandwidth,
                               const Eigen::Vector4d& scales, std::optional<std::size_t> left_out) {
  std::vector<double> square(batches.size(), std::numeric_limits<double>::infinity());
  for (std::size_t k = 0; k < batches.size(); ++k) {
    if (k == left_out) continue;
    const double d = distance(job, batches[k].start, scales);
    square[k] = d * d;
  }
  const double least = *std::min_element(square.begin(), square.end());
  const double near = order_statistic(square, std::min(kFewestWeighed, square.size()) - 1);
  std::vector<double> weights;
  for (const double one : square) {
    double weight = std::isfinite(one) ? 1.0 : 0.0;
    if (std::isfinite(one) && std::isfinite(bandwidth)) {
      weight = std::exp(-(one - least) / (2.0 * bandwidth * bandwidth));
    }
    weights.push_back(weight < kLeastWeight && one > near ? 0.0 : weight);
  }
  return weights;
}

// Batches most like the job, the nearest first: each in its turn is the job.
std::vector<std::size_t> like_the_job(std::span<const Batch> batches, const BatchStart& job,
                                      const Eigen::Vector4d& scales) {
  std::vector<std::size_t> order(batches.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return distance(job, batches[a].start, scales) < distance(job, batches[b].start, scales);
  });
  order.resize(std::min(order.size(), kLike));
  return order;
}

}  // namespace

BatchWeights batch_weights(std::span<const Batch> batches, const BatchStart& job, RegressionMethod method) {
  constexpr std::size_t kFewestToChooseFrom = 3;
  if (batches.size() < kFewestToChooseFrom) {
    throw Error(
        fmt::format("expected at least {} batches to choose from, found {}.", kFewestToChooseFrom, batches.size()));
  }
  const Eigen::Vector4d scales = scales_of(batches);
  const auto m = static_cast<std::size_t>(batches.front().moments.mean.size() - 1);
  const std::vector<RegressionSettings> settings = settings_of(method, m);
  const std::vector<std::size_t> like = like_the_job(batches, job, scales);
  // Errors of the batches like the job, each left out, by every bandwidth and setting.
  Eigen::MatrixXd um(static_cast<Eigen::Index>(like.size()),
                     static_cast<Eigen::Index>(kBandwidths.size() * settings.size()));
  in_parallel(like.size(), [&](std::size_t q) {
    const Batch& left_out = batches[like[q]];
    Eigen::Index at = 0;
    for (const double width : kBandwidths) {
      const std::vector<double> weights = weights_at(batches, left_out.start, width, scales, like[q]);
      for (const Regression& one : regress(merged(batches, weights), settings)) {
        um(static_cast<Eigen::Index>(q), at++) = rmse_um(left_out.moments, one);
      }
    }
  });
  Eigen::Index best = 0;
  um.cwiseAbs2().colwise().mean().minCoeff(&best);
  BatchWeights result;
  for (const Batch& batch : batches) result.distance.push_back(distance(job, batch.start, scales));
  result.bandwidth = kBandwidths.at(static_cast<std::size_t>(best) / settings.size());
  result.weight = weights_at(batches, job, result.bandwidth, scales, std::nullopt);
  result.settings = settings[static_cast<std::size_t>(best) % settings.size()];
  return result;
}

}  // namespace ballbar
