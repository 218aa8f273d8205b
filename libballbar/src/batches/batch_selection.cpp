#include "ballbar/batches/batch_selection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "ballbar/error.hpp"
#include "ballbar/numerics/order_statistic.hpp"
#include "ballbar/numerics/parallel.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kLike = 30;   // batches that stand for the job
constexpr std::size_t kEvery = 40;  // numbers of batches up to here are all tried, then each by a tenth more
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

double room_apart(const BatchStart& job, const BatchStart& batch) {
  return std::abs(job.room_first_degC - batch.room_mean_degC);
}

// The batches but `left_out`, the nearest room first.
std::vector<std::size_t> ranking(std::span<const Batch> batches, const BatchStart& job,
                                 std::optional<std::size_t> left_out) {
  std::vector<std::size_t> order;
  for (std::size_t k = 0; k < batches.size(); ++k) {
    if (k != left_out) order.push_back(k);
  }
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return room_apart(job, batches[a].start) < room_apart(job, batches[b].start);
  });
  return order;
}

// w_k over the largest of them; 0 for `left_out`, and where it is next to nothing but for the nearest few.
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

// Batches most like the job: each in its turn is the job.
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

std::vector<std::size_t> numbers_to_try(std::size_t most) {
  std::vector<std::size_t> numbers;
  for (std::size_t i = 2; i < most; i = i < kEvery ? i + 1 : i + i / 10) numbers.push_back(i);
  numbers.push_back(most);
  return numbers;
}

RegressionSettings settings_for(const Moments& moments, const RegressionSettings& chosen,
                                const std::optional<double>& share) {
  RegressionSettings settings = chosen;
  if (share && chosen.method == RegressionMethod::pcr) settings.components = components_for(moments, *share);
  return settings;
}

// The number of nearest batches that predicts batches like the job best, and the error of every number tried.
void choose_number(std::span<const Batch> batches, const std::vector<std::size_t>& like,
                   const SelectionOptions& options, Selection& selection) {
  const std::vector<std::size_t> numbers = numbers_to_try(batches.size() - 1);
  Eigen::MatrixXd square(static_cast<Eigen::Index>(like.size()), static_cast<Eigen::Index>(numbers.size()));
  in_parallel(like.size(), [&](std::size_t q) {
    const std::vector<std::size_t> order = ranking(batches, batches[like[q]].start, like[q]);
    Moments moments;
    std::size_t taken = 0;
    for (std::size_t n = 0; n < numbers.size(); ++n) {
      while (taken < numbers[n]) moments = merged(moments, batches[order[taken++]].moments);
      const Regression one = regress(moments, settings_for(moments, selection.settings, options.share));
      const double error = rmse_um(batches[like[q]].moments, one);
      square(static_cast<Eigen::Index>(q), static_cast<Eigen::Index>(n)) = error * error;
    }
  });
  const Eigen::VectorXd mean = square.colwise().mean();
  Eigen::Index best = 0;
  mean.minCoeff(&best);
  for (std::size_t n = 0; n < numbers.size(); ++n) {
    selection.held_out_um.emplace_back(numbers[n], std::sqrt(mean[static_cast<Eigen::Index>(n)]));
  }
  const std::size_t number = numbers[static_cast<std::size_t>(best)];
  selection.by_held_out = number == batches.size() - 1 ? batches.size() : number;
}

// Bandwidth and settings of the weighted regression.
void choose_weights(std::span<const Batch> batches, const BatchStart& job, const std::vector<std::size_t>& like,
                    const Eigen::Vector4d& scales, RegressionMethod method, Selection& selection) {
  const auto m = static_cast<std::size_t>(batches.front().moments.mean.size() - 1);
  const std::vector<RegressionSettings> settings = settings_of(method, m);
  const std::size_t choices = kBandwidths.size() * settings.size();
  Eigen::MatrixXd square(static_cast<Eigen::Index>(like.size()), static_cast<Eigen::Index>(choices));
  in_parallel(like.size(), [&](std::size_t q) {
    for (std::size_t b = 0; b < kBandwidths.size(); ++b) {
      const std::vector<double> weights = weights_at(batches, batches[like[q]].start, kBandwidths[b], scales, like[q]);
      const std::vector<Regression> all = regress(merged(batches, weights), settings);
      for (std::size_t s = 0; s < settings.size(); ++s) {
        const double error = rmse_um(batches[like[q]].moments, all[s]);
        square(static_cast<Eigen::Index>(q), static_cast<Eigen::Index>(b * settings.size() + s)) = error * error;
      }
    }
  });
  const Eigen::VectorXd mean = square.colwise().mean();
  Eigen::Index best = 0;
  mean.minCoeff(&best);
  selection.bandwidth = kBandwidths.at(static_cast<std::size_t>(best) / settings.size());
  selection.weights_settings = settings[static_cast<std::size_t>(best) % settings.size()];
  const std::vector<double> weights = weights_at(batches, job, selection.bandwidth, scales, std::nullopt);
  for (RankedBatch& ranked : selection.ranked) ranked.weight = weights[ranked.batch];
  selection.of_weights = regress(merged(batches, weights), selection.weights_settings);
}

// The first model whose modelling error falls clearly below all those before it.
void choose_by_paper(double fall, Selection& selection) {
  selection.by_paper = selection.ranked.size();
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < selection.ranked.size(); ++i) {
    const double now = selection.ranked[i].modelling_rmse_um;
    if (i > 0 && now < (1.0 - fall) * least) {
      selection.by_paper = i + 1;
      selection.paper_found = true;
      return;
    }
    least = std::min(least, now);
  }
}

}  // namespace

Selection select_batches(std::span<const Batch> batches, const BatchStart& job, const Moments* measured,
                         const SelectionOptions& options) {
  constexpr std::size_t kFewest = 3;
  if (batches.size() < kFewest) {
    throw Error(fmt::format("expected at least {} batches to choose from, found {}.", kFewest, batches.size()));
  }
  const Eigen::Vector4d scales = scales_of(batches);
  Selection selection;
  selection.settings = choose_by_held_out(batches, options.method).settings;
  Moments moments;
  std::vector<Regression> regressions;
  for (const std::size_t k : ranking(batches, job, std::nullopt)) {
    moments = merged(moments, batches[k].moments);
    RankedBatch ranked;
    ranked.batch = k;
    ranked.room_apart_K = room_apart(job, batches[k].start);
    ranked.distance = distance(job, batches[k].start, scales);
    ranked.settings = settings_for(moments, selection.settings, options.share);
    regressions.push_back(regress(moments, ranked.settings));
    ranked.modelling_rmse_um = rmse_um(moments, regressions.back());
    if (measured != nullptr) ranked.predicted_rmse_um = rmse_um(*measured, regressions.back());
    selection.ranked.push_back(ranked);
  }
  choose_by_paper(options.fall, selection);
  const std::vector<std::size_t> like = like_the_job(batches, job, scales);
  choose_number(batches, like, options, selection);
  choose_weights(batches, job, like, scales, options.method, selection);
  selection.of_paper = regressions[selection.by_paper - 1];
  selection.of_held_out = regressions[selection.by_held_out - 1];
  selection.of_all = regressions.back();
  if (measured == nullptr) return selection;
  selection.paper_um = rmse_um(*measured, selection.of_paper);
  selection.held_out_rmse_um = rmse_um(*measured, selection.of_held_out);
  selection.weights_um = rmse_um(*measured, selection.of_weights);
  selection.all_um = rmse_um(*measured, selection.of_all);
  return selection;
}

RandomChoices random_choices(std::span<const Batch> batches, const Moments& measured,
                             const RegressionSettings& settings, const std::optional<double>& share, double than_um,
                             const RandomOptions& options) {
  assert(options.choices > 0 && options.batches <= batches.size());
  std::mt19937_64 random(options.seed);
  RandomChoices result;
  std::vector<std::size_t> order(batches.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t r = 0; r < options.choices; ++r) {
    Moments moments;
    for (std::size_t i = 0; i < options.batches; ++i) {
      std::swap(order[i], order[i + random() % (order.size() - i)]);
      moments = merged(moments, batches[order[i]].moments);
    }
    result.predicted_rmse_um.push_back(rmse_um(measured, regress(moments, settings_for(moments, settings, share))));
  }
  std::sort(result.predicted_rmse_um.begin(), result.predicted_rmse_um.end());
  const auto worse = std::count_if(result.predicted_rmse_um.begin(), result.predicted_rmse_um.end(),
                                   [&](double um) { return um > than_um; });
  result.share_worse = static_cast<double>(worse) / static_cast<double>(options.choices);
  return result;
}

std::vector<double> weights_of(const Selection& selection) {
  std::vector<double> weights(selection.ranked.size());
  for (const RankedBatch& ranked : selection.ranked) weights[ranked.batch] = ranked.weight;
  return weights;
}

}  // namespace ballbar
