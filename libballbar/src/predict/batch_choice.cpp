#include "ballbar/predict/batch_choice.hpp"

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

// Mean square of the errors of batches like the job, each left out: one number for each of so many ways to predict.
// errors_um(q): of the batch q by all ways.
Eigen::VectorXd mean_squares(const std::vector<std::size_t>& like, std::size_t ways, const auto& errors_um) {
  Eigen::MatrixXd um(static_cast<Eigen::Index>(like.size()), static_cast<Eigen::Index>(ways));
  in_parallel(like.size(),
              [&](std::size_t q) { um.row(static_cast<Eigen::Index>(q)) = errors_um(like[q]).transpose(); });
  return um.cwiseAbs2().colwise().mean();
}

// The number of nearest batches that predicts batches like the job best, and the error of every number tried.
std::size_t held_out_number(std::span<const Batch> batches, const std::vector<std::size_t>& like,
                            const RegressionSettings& settings, const ChoiceOptions& options,
                            std::vector<HeldOutNumber>& tried) {
  const std::vector<std::size_t> numbers = numbers_to_try(batches.size() - 1);
  const Eigen::VectorXd mean = mean_squares(like, numbers.size(), [&](std::size_t q) {
    const std::vector<std::size_t> order = ranking(batches, batches[q].start, q);
    Eigen::VectorXd um(static_cast<Eigen::Index>(numbers.size()));
    Moments moments;
    std::size_t taken = 0;
    for (std::size_t n = 0; n < numbers.size(); ++n) {
      while (taken < numbers[n]) moments = merged(moments, batches[order[taken++]].moments);
      const Regression one = regress(moments, settings_for(moments, settings, options.share));
      um[static_cast<Eigen::Index>(n)] = rmse_um(batches[q].moments, one);
    }
    return um;
  });
  Eigen::Index best = 0;
  mean.minCoeff(&best);
  for (std::size_t n = 0; n < numbers.size(); ++n) {
    tried.push_back({numbers[n], std::sqrt(mean[static_cast<Eigen::Index>(n)])});
  }
  const std::size_t number = numbers[static_cast<std::size_t>(best)];
  return number == batches.size() - 1 ? batches.size() : number;
}

// Bandwidth and settings of the weighted regression.
BatchChoice weighted(std::span<const Batch> batches, const BatchStart& job, const std::vector<std::size_t>& like,
                     const Eigen::Vector4d& scales, RegressionMethod method, double& bandwidth) {
  const auto m = static_cast<std::size_t>(batches.front().moments.mean.size() - 1);
  const std::vector<RegressionSettings> settings = settings_of(method, m);
  const std::size_t choices = kBandwidths.size() * settings.size();
  const Eigen::VectorXd mean = mean_squares(like, choices, [&](std::size_t q) {
    Eigen::VectorXd um(static_cast<Eigen::Index>(choices));
    Eigen::Index at = 0;
    for (const double width : kBandwidths) {
      const std::vector<double> weights = weights_at(batches, batches[q].start, width, scales, q);
      for (const Regression& one : regress(merged(batches, weights), settings)) {
        um[at++] = rmse_um(batches[q].moments, one);
      }
    }
    return um;
  });
  Eigen::Index best = 0;
  mean.minCoeff(&best);
  bandwidth = kBandwidths.at(static_cast<std::size_t>(best) / settings.size());
  BatchChoice choice;
  choice.take = Take::weights;
  choice.weights = weights_at(batches, job, bandwidth, scales, std::nullopt);
  choice.batches = static_cast<std::size_t>(
      std::count_if(choice.weights.begin(), choice.weights.end(), [](double weight) { return weight > 0.0; }));
  choice.settings = settings[static_cast<std::size_t>(best) % settings.size()];
  return choice;
}

// The first model whose modelling error falls clearly below all those before it.
std::optional<std::size_t> paper_number(const std::vector<RankedBatch>& ranked, double fall) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < ranked.size(); ++i) {
    const double now = ranked[i].modelling_rmse_um;
    if (i > 0 && now < (1.0 - fall) * least) return i + 1;
    least = std::min(least, now);
  }
  return std::nullopt;
}

BatchChoice first_of(const std::vector<RankedBatch>& ranked, std::size_t number, Take take) {
  BatchChoice choice{take, number, std::vector<double>(ranked.size(), 0.0), ranked[number - 1].settings,
                     ranked[number - 1].predicted_rmse_um};
  for (std::size_t i = 0; i < number; ++i) choice.weights[ranked[i].batch] = 1.0;
  return choice;
}

}  // namespace

BatchRanking batch_ranking(std::span<const Batch> batches, const BatchStart& job, const Moments* measured,
                           const ChoiceOptions& options) {
  constexpr std::size_t kFewest = 3;
  if (batches.size() < kFewest) {
    throw Error(fmt::format("expected at least {} batches to choose from, found {}.", kFewest, batches.size()));
  }
  const Eigen::Vector4d scales = scales_of(batches);
  const RegressionSettings chosen = best_settings(batches, options.method);
  BatchRanking result;
  Moments moments;
  for (const std::size_t k : ranking(batches, job, std::nullopt)) {
    moments = merged(moments, batches[k].moments);
    RankedBatch ranked;
    ranked.batch = k;
    ranked.name = batches[k].name;
    ranked.room_apart_K = room_apart(job, batches[k].start);
    ranked.distance = distance(job, batches[k].start, scales);
    ranked.settings = settings_for(moments, chosen, options.share);
    const Regression one = regress(moments, ranked.settings);
    ranked.modelling_rmse_um = rmse_um(moments, one);
    if (measured != nullptr) ranked.predicted_rmse_um = rmse_um(*measured, one);
    result.ranked.push_back(std::move(ranked));
  }
  const std::vector<std::size_t> like = like_the_job(batches, job, scales);
  const std::optional<std::size_t> by_paper = paper_number(result.ranked, options.fall);
  const std::size_t by_held_out = held_out_number(batches, like, chosen, options, result.held_out);
  BatchChoice by_weights = weighted(batches, job, like, scales, options.method, result.bandwidth);
  for (RankedBatch& ranked : result.ranked) ranked.weight = by_weights.weights[ranked.batch];
  if (measured != nullptr) {
    by_weights.predicted_rmse_um =
        rmse_um(*measured, regress(merged(batches, by_weights.weights), by_weights.settings));
  }
  result.paper_found = by_paper.has_value();
  result.choices = {first_of(result.ranked, by_paper.value_or(batches.size()), Take::paper),
                    first_of(result.ranked, by_held_out, Take::held_out), std::move(by_weights),
                    first_of(result.ranked, batches.size(), Take::all)};
  return result;
}

RandomChoices random_choices(std::span<const Batch> batches, const Moments& measured, const BatchChoice& than,
                             const std::optional<double>& share, const RandomOptions& options) {
  RandomChoices result;
  result.batches = static_cast<std::size_t>(std::lround(effective_batches(than.weights)));
  assert(options.choices > 0 && result.batches <= batches.size());
  std::mt19937_64 random(options.seed);
  std::vector<std::size_t> order(batches.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t r = 0; r < options.choices; ++r) {
    Moments moments;
    for (std::size_t i = 0; i < result.batches; ++i) {
      std::swap(order[i], order[i + random() % (order.size() - i)]);
      moments = merged(moments, batches[order[i]].moments);
    }
    result.predicted_rmse_um.push_back(
        rmse_um(measured, regress(moments, settings_for(moments, than.settings, share))));
  }
  std::sort(result.predicted_rmse_um.begin(), result.predicted_rmse_um.end());
  const auto worse = std::count_if(result.predicted_rmse_um.begin(), result.predicted_rmse_um.end(),
                                   [&](double um) { return um > *than.predicted_rmse_um; });
  result.share_worse = static_cast<double>(worse) / static_cast<double>(options.choices);
  return result;
}

}  // namespace ballbar
