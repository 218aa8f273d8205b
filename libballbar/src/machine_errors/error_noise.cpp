#include "machine_errors/error_noise.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>

#include "ballbar/units.hpp"

namespace ballbar {
namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr std::array kWhiteOfCorrelated = {0.1, 0.33, 1.0, 3.0};  // w / q
constexpr double kUsualWhite = 0.33;
constexpr std::array kFineMemories = {0.45, 0.58, 0.75, 1.0, 1.3, 1.7, 2.2};  // times the best of the first look
constexpr std::size_t kMemories = 6;
constexpr double kMemoriesATurn = 16.0;
constexpr double kLeastWeight = 1e-3;
constexpr double kLeastVariance = 1e-6;  // of q = 1
constexpr double kLeast_um = 1e-4;       // readings are written to 0.01 um

// From two rows to a sixteenth of a turn, evenly in the logarithm: what lasts longer has the forms of the errors, and
// the readings cannot tell it from them.
std::array<double, kMemories> memories_s(const ErrorRows& rows) {
  double time_s = 0.0, turned_rad = 0.0;
  double steps = 0.0;
  for (Eigen::Index i = 1; i < rows.size(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    if (rows.recording[at] != rows.recording[at - 1]) continue;
    time_s += rows.time_s[i] - rows.time_s[i - 1];
    turned_rad += std::abs(rows.angle_rad[i] - rows.angle_rad[i - 1]);
    steps += 1.0;
  }
  const double longest_s = time_s * (2.0 * kPi / turned_rad) / kMemoriesATurn;
  const double shortest_s = std::min(time_s / steps, 0.5 * longest_s);
  std::array<double, kMemories> memories{};
  for (std::size_t k = 0; k < kMemories; ++k) {
    const double share = static_cast<double>(k) / (kMemories - 1);
    memories[k] = shortest_s * std::pow(longest_s / shortest_s, share);
  }
  return memories;
}

double decay_before(const ErrorRows& rows, Eigen::Index i, double memory_s) {
  const auto at = static_cast<std::size_t>(i);
  if (i == 0 || rows.recording[at] != rows.recording[at - 1]) return 0.0;
  return std::exp(-(rows.time_s[i] - rows.time_s[i - 1]) / memory_s);
}

// Of the part with a memory, for q = 1, what a mean over a row keeps: `with_others` k, and its own variance beyond k^2.
struct RowMean {
  double with_others = 1.0;
  double own = 0.0;
};
RowMean row_mean(double count, double interval_s, double memory_s) {
  if (count < 1.5) return {};
  const double half = 0.5 * interval_s / memory_s;
  const double with_others = std::sinh(count * half) / (count * std::sinh(half));
  double variance = count;
  for (double m = 1.0; m < count - 0.5; m += 1.0) variance += 2.0 * (count - m) * std::exp(-2.0 * half * m);
  return {with_others, variance / (count * count) - with_others * with_others};
}

struct Restricted {
  double log_likelihood = 0.0;
  double variance = 0.0;  // s^2: of q^2 = 1
};

// Every column becomes its innovations over their standard deviation, for q = 1.
Restricted restricted(const ErrorRows& rows, const RowMajor& data, double memory_s, double white) {
  const Eigen::Index n = rows.size(), p = data.cols() - 1;
  RowMajor innovations = data;
  Eigen::RowVectorXd predicted = Eigen::RowVectorXd::Zero(p + 1);
  double known = 0.0;  // variance of the prediction
  double log_variances = 0.0;
  for (Eigen::Index i = 0; i < n; ++i) {
    const double decay = decay_before(rows, i, memory_s);
    known = decay * decay * known + (1.0 - decay * decay);
    const RowMean mean = row_mean(rows.count[i], rows.interval_s[i], memory_s);
    const double variance = std::max(
        mean.with_others * mean.with_others * known + mean.own + white * white / rows.count[i], kLeastVariance);
    const double gain = known * mean.with_others / variance;
    predicted *= decay;
    innovations.row(i) -= mean.with_others * predicted;
    predicted += gain * innovations.row(i);
    innovations.row(i) /= std::sqrt(variance);
    known *= 1.0 - gain * mean.with_others;
    log_variances += std::log(variance);
  }
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(p + 1, p + 1);
  gram.selfadjointView<Eigen::Lower>().rankUpdate(innovations.transpose());
  // What a column hardly has beside the others is not fitted.
  for (Eigen::Index k = 0; k < p; ++k) gram(k, k) *= 1.0 + 1e-9;
  const Eigen::LLT<Eigen::MatrixXd> root(gram);
  const double left = root.matrixLLT()(p, p);
  const auto freedom = static_cast<double>(std::max<Eigen::Index>(n - p, 1));
  Restricted result;
  result.variance = std::max(left * left / freedom, kLeast_um * kLeast_um);
  const double log_columns = 2.0 * root.matrixLLT().diagonal().head(p).array().log().sum();
  result.log_likelihood = -0.5 * (freedom * std::log(result.variance) + log_variances + log_columns);
  return result;
}

}  // namespace

std::vector<WeightedNoise> error_noise(const ErrorRows& rows, const Eigen::MatrixXd& columns) {
  RowMajor data(rows.size(), columns.cols() + 1);
  data.leftCols(columns.cols()) = columns;
  // Alike in size, so that none is lost to rounding.
  for (Eigen::Index k = 0; k < columns.cols(); ++k) {
    const double size = data.col(k).norm();
    if (size > 0.0) data.col(k) /= size;
  }
  data.col(columns.cols()) = rows.deviation_um;
  std::vector<WeightedNoise> noises;
  noises.reserve(kMemories + kFineMemories.size() * kWhiteOfCorrelated.size());
  const auto look_at = [&](double memory_s, double white) {
    const Restricted found = restricted(rows, data, memory_s, white);
    const double correlated_um = std::sqrt(found.variance);
    noises.push_back({found.log_likelihood, {white * correlated_um, correlated_um, memory_s, found.log_likelihood}});
  };
  const auto likelier = [](const WeightedNoise& a, const WeightedNoise& b) { return a.weight > b.weight; };
  const std::array<double, kMemories> memories = memories_s(rows);
  for (const double memory_s : memories) look_at(memory_s, kUsualWhite);
  const double best_s = std::min_element(noises.begin(), noises.end(), likelier)->noise.correlation_time_s;
  noises.clear();
  for (const double times : kFineMemories) {
    const double memory_s = times * best_s;
    if (memory_s > 1.0001 * memories.back()) continue;
    for (const double white : kWhiteOfCorrelated) look_at(memory_s, white);
  }
  std::stable_sort(noises.begin(), noises.end(), likelier);
  const double most = noises.front().weight;
  double sum = 0.0;
  for (WeightedNoise& noise : noises) {
    noise.weight = std::exp(noise.weight - most);
    if (noise.weight < kLeastWeight) noise.weight = 0.0;
    sum += noise.weight;
  }
  std::erase_if(noises, [](const WeightedNoise& noise) { return !(noise.weight > 0.0); });
  for (WeightedNoise& noise : noises) noise.weight /= sum;
  return noises;
}

Eigen::MatrixXd scatter_of(const Eigen::MatrixXd& columns, const ErrorRows& rows,
                           const std::vector<WeightedNoise>& noises) {
  const RowMajor z = columns;
  RowMajor correlated = RowMajor::Zero(z.rows(), z.cols());  // V Z
  for (const WeightedNoise& one : noises) {
    const double q2 = one.weight * one.noise.correlated_um * one.noise.correlated_um;
    const double w2 = one.weight * one.noise.white_um * one.noise.white_um;
    const double memory_s = one.noise.correlation_time_s;
    // sum over j of k_j exp(-|t_i - t_j| / theta) z_j: those before and the row itself, then those after.
    Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(z.cols());
    for (Eigen::Index i = 0; i < z.rows(); ++i) {
      const RowMean mean = row_mean(rows.count[i], rows.interval_s[i], memory_s);
      sum = decay_before(rows, i, memory_s) * sum + mean.with_others * z.row(i);
      correlated.row(i) += (q2 * mean.with_others) * sum + (q2 * mean.own + w2 / rows.count[i]) * z.row(i);
    }
    sum.setZero();
    for (Eigen::Index i = z.rows() - 1; i > 0; --i) {
      const double kept = row_mean(rows.count[i], rows.interval_s[i], memory_s).with_others;
      sum = decay_before(rows, i, memory_s) * (sum + kept * z.row(i));
      const double before = row_mean(rows.count[i - 1], rows.interval_s[i - 1], memory_s).with_others;
      correlated.row(i - 1) += (q2 * before) * sum;
    }
  }
  Eigen::MatrixXd scatter = z.transpose() * correlated;
  return 0.5 * (scatter + scatter.transpose());
}

double slow_variance_um2(const ErrorRows& rows, const std::vector<WeightedNoise>& noises) {
  const double readings = rows.count.sum();
  const double whole_s = rows.time_s[rows.size() - 1] - rows.time_s[0];
  const double interval_s = whole_s / std::max(readings - 1.0, 1.0);
  double variance = 0.0;
  for (const WeightedNoise& one : noises) {
    const double decay = std::exp(-interval_s / one.noise.correlation_time_s);
    variance += one.weight * (one.noise.white_um * one.noise.white_um +
                              one.noise.correlated_um * one.noise.correlated_um * (1.0 + decay) / (1.0 - decay));
  }
  return variance;
}

}  // namespace ballbar
