#include "machine_errors/error_noise.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <span>
#include <utility>

#include "ballbar/units.hpp"
#include "noise/linear_filter.hpp"
#include "noise/restricted_likelihood.hpp"

namespace ballbar {
namespace {

constexpr std::array kWhiteOfCorrelated = {0.1, 0.33, 1.0, 3.0, 10.0};  // w / q
constexpr std::size_t kUsualWhite = 1;
constexpr std::array kFineMemories = {0.5, 0.7, 1.0, 1.4, 2.0};  // times the best of the first look
constexpr std::size_t kMemories = 6;
constexpr double kMemoriesATurn = 16.0;
constexpr double kLeastWeight = 0.03;    // of the likeliest
constexpr double kLeastVariance = 1e-6;  // of q = 1
constexpr double kLeastOfSpan = 1e-5;    // of a column that the others do not have, or it is theirs
constexpr double kClearExcess = 1.5;     // of variances
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

// The correlated part, for q = 1, in a mean over a row: what it shares with others (k), and its variance.
struct MeanOfRow {
  double with_others = 1.0, variance = 1.0;
};

// Row by row.
struct RowMemory {
  std::vector<double> with_others, variance;
};

// Of a mean of `count` readings.
MeanOfRow mean_of_row(double count, double interval_s, double memory_s) {
  if (count < 1.5) return {};
  const double half = 0.5 * interval_s / memory_s;
  const double with_others = std::sinh(count * half) / (count * std::sinh(half));
  double variance = count;
  for (double m = 1.0; m < count - 0.5; m += 1.0) variance += 2.0 * (count - m) * std::exp(-2.0 * half * m);
  return {with_others, variance / (count * count)};
}

RowMemory row_memory(const ErrorRows& rows, double memory_s) {
  const auto n = static_cast<std::size_t>(rows.size());
  RowMemory memory{std::vector<double>(n), std::vector<double>(n)};
  std::map<std::pair<double, double>, MeanOfRow> known;  // few rows differ
  for (std::size_t i = 0; i < n; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    const std::pair key{rows.count[row], rows.interval_s[row]};
    auto found = known.find(key);
    if (found == known.end()) found = known.emplace(key, mean_of_row(key.first, key.second, memory_s)).first;
    memory.with_others[i] = found->second.with_others;
    memory.variance[i] = found->second.variance;
  }
  return memory;
}

// Recordings, rows after one another, remember nothing of the one before.
bool is_start(const ErrorRows& rows, std::size_t row) {
  return row == 0 || rows.recording[row] != rows.recording[row - 1];
}

std::vector<std::size_t> starts_of(const ErrorRows& rows) {
  std::vector<std::size_t> starts;
  for (std::size_t i = 0; i < rows.recording.size(); ++i) {
    if (is_start(rows, i)) starts.push_back(i);
  }
  return starts;
}

// What each row keeps from the one before; 0 at a start.
std::vector<double> decays_of(const ErrorRows& rows, double memory_s) {
  std::vector<double> decays(rows.recording.size(), 0.0);
  double step_s = -1.0, decay = 0.0;
  for (std::size_t i = 0; i < decays.size(); ++i) {
    if (is_start(rows, i)) continue;
    const auto row = static_cast<Eigen::Index>(i);
    const double step = rows.time_s[row] - rows.time_s[row - 1];
    if (std::abs(step - step_s) > 1e-9 * step) {
      step_s = step;
      decay = std::exp(-step / memory_s);
    }
    decays[i] = decay;
  }
  return decays;
}

LinearFilter filter_of(const ErrorRows& rows, double memory_s) {
  const RowMemory memory = row_memory(rows, memory_s);
  const Eigen::ArrayXd of_white = rows.count.array().inverse();
  const std::vector<std::size_t> starts = starts_of(rows);
  return LinearFilter({rows.time_s.data(), rows.recording.size()},
                      {.relative_variance = {of_white.data(), rows.recording.size()},
                       .memory_share = memory.with_others,
                       .memory_variance = memory.variance,
                       .starts = starts});
}

// Orthonormal columns that span these, by Gram-Schmidt. Those of one recording alone come first, so that they stay 0 in
// the others.
Eigen::MatrixXd span_of(const Eigen::MatrixXd& columns, const std::vector<std::size_t>& starts) {
  const auto is_of_one = [&](Eigen::Index k) {
    std::size_t recordings = 0;
    for (std::size_t r = 0; r < starts.size(); ++r) {
      const auto first = static_cast<Eigen::Index>(starts[r]);
      const Eigen::Index end = r + 1 < starts.size() ? static_cast<Eigen::Index>(starts[r + 1]) : columns.rows();
      if (!columns.col(k).segment(first, end - first).isZero(0.0)) ++recordings;
    }
    return recordings == 1;
  };
  std::vector<Eigen::Index> order(static_cast<std::size_t>(columns.cols()));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  std::stable_partition(order.begin(), order.end(), is_of_one);
  Eigen::MatrixXd span(columns.rows(), columns.cols());
  Eigen::Index rank = 0;
  for (const Eigen::Index k : order) {
    const double size = columns.col(k).norm();
    if (!(size > 0.0)) continue;
    span.col(rank) = columns.col(k) / size;
    for (int pass = 0; pass < 2; ++pass)
      span.col(rank) -= span.leftCols(rank) * (span.leftCols(rank).transpose() * span.col(rank)).eval();
    const double own = span.col(rank).norm();
    if (own > kLeastOfSpan) span.col(rank++) /= own;
  }
  return span.leftCols(rank);
}

// The joined row of each quiet one; -1: it is not quiet.
std::vector<Eigen::Index> joined_row_of(const ErrorRows& rows) {
  std::vector<Eigen::Index> joined(static_cast<std::size_t>(rows.size()), -1);
  Eigen::Index row = -1;
  Eigen::Index first = -2;  // of the joined row
  for (Eigen::Index i = 0; i < rows.size(); ++i) {
    if (rows.from_reversal_deg[i] <= kNearReversal_deg) continue;
    const auto at = static_cast<std::size_t>(i);
    const bool second = first == i - 1 && rows.recording[at] == rows.recording[at - 1];
    if (!second) {
      ++row;
      first = i;
    } else {
      first = -2;
    }
    joined[at] = row;
  }
  return joined;
}

}  // namespace

std::vector<WeightedNoise> error_noise(const ErrorRows& rows, const Eigen::MatrixXd& columns) {
  // Of what the columns span: on a short arc some are the sum of others, and their X' V^-1 X has no root.
  const std::vector<std::size_t> starts = starts_of(rows);
  const RestrictedLikelihood likelihood({rows.deviation_um.data(), rows.recording.size()}, span_of(columns, starts),
                                        starts);
  std::map<double, LinearFilter> filters;                          // by memory
  std::map<std::pair<double, std::size_t>, WeightedNoise> points;  // by memory and w / q; weights are logarithms
  const auto look_at = [&](double memory_s, std::size_t white) {
    const auto [point, is_new] = points.try_emplace({memory_s, white});
    if (!is_new) return;
    const auto filter = filters.try_emplace(memory_s, filter_of(rows, memory_s)).first;
    const double ratio = kWhiteOfCorrelated[white];
    const LinearFilter::Sums sums = likelihood.sums(filter->second, {ratio * ratio, 1.0, memory_s});
    const auto freedom = static_cast<double>(std::max<Eigen::Index>(rows.size() - likelihood.columns(), 1));
    const double variance = std::max(sums.squares / freedom, kLeast_um * kLeast_um);  // s^2: of q^2 = 1
    const double log_likelihood = -0.5 * (freedom * std::log(variance) + sums.log_variances);
    const double correlated_um = std::sqrt(variance);
    point->second = {log_likelihood, {ratio * correlated_um, correlated_um, memory_s, log_likelihood}};
  };
  const auto likeliest = [&] {
    return std::max_element(points.begin(), points.end(),
                            [](const auto& a, const auto& b) { return a.second.weight < b.second.weight; })
        ->first;
  };
  const std::array<double, kMemories> memories = memories_s(rows);
  for (const double memory_s : memories) look_at(memory_s, kUsualWhite);
  std::vector<double> fine_s;
  for (const double times : kFineMemories) {
    const double memory_s = times * likeliest().first;
    if (memory_s <= 1.0001 * memories.back()) fine_s.push_back(memory_s);
  }
  // What lies beside each point that is not unlikely, until nothing new does.
  for (std::size_t known = 0; known != points.size();) {
    known = points.size();
    const double least = points[likeliest()].weight + std::log(kLeastWeight);
    const auto so_far = points;
    for (const auto& [point, noise] : so_far) {
      const auto place = std::find(fine_s.begin(), fine_s.end(), point.first);
      if (place == fine_s.end() || noise.weight < least) continue;
      const std::size_t most_white = std::min(point.second + 2, kWhiteOfCorrelated.size());
      for (auto m = place - (place == fine_s.begin() ? 0 : 1); m != fine_s.end() && m <= place + 1; ++m) {
        for (std::size_t w = point.second - std::min<std::size_t>(point.second, 1); w < most_white; ++w) look_at(*m, w);
      }
    }
  }
  std::vector<WeightedNoise> noises;
  const double most = points[likeliest()].weight;
  double sum = 0.0;
  for (const auto& [place, point] : points) {
    const double weight = std::exp(point.weight - most);
    const bool is_fine = std::find(fine_s.begin(), fine_s.end(), place.first) != fine_s.end();
    if (!is_fine || weight < kLeastWeight) continue;
    noises.push_back({weight, point.noise});
    sum += weight;
  }
  std::stable_sort(noises.begin(), noises.end(), [](const auto& a, const auto& b) { return a.weight > b.weight; });
  for (WeightedNoise& noise : noises) noise.weight /= sum;
  return noises;
}

Eigen::MatrixXd spread_of(const Eigen::MatrixXd& columns, const ErrorRows& rows,
                          const std::vector<WeightedNoise>& noises) {
  std::map<double, std::pair<double, double>> by_memory;  // q^2 and w^2, each times its weight
  for (const WeightedNoise& one : noises) {
    auto& [q2, w2] = by_memory[one.noise.correlation_time_s];
    q2 += one.weight * one.noise.correlated_um * one.noise.correlated_um;
    w2 += one.weight * one.noise.white_um * one.noise.white_um;
  }
  struct Spread {
    double q2 = 0.0;
    std::vector<double> with_others, decay;  // row by row
  };
  Eigen::ArrayXd own = Eigen::ArrayXd::Zero(columns.rows());  // what a row has of itself alone
  std::vector<Spread> spreads;
  spreads.reserve(by_memory.size());
  for (const auto& [memory_s, variances] : by_memory) {
    const auto [q2, w2] = variances;
    RowMemory memory = row_memory(rows, memory_s);
    for (Eigen::Index i = 0; i < own.size(); ++i) {
      const auto at = static_cast<std::size_t>(i);
      own[i] += q2 * (memory.variance[at] - memory.with_others[at] * memory.with_others[at]) + w2 / rows.count[i];
    }
    spreads.push_back({q2, std::move(memory.with_others), decays_of(rows, memory_s)});
  }
  using RowMajor = Eigen::Array<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const RowMajor z = columns.array();
  RowMajor all = z.colwise() * own;  // V Z
  Eigen::ArrayXd sum(z.cols());
  for (const Spread& of : spreads) {
    // sum over j of k_j exp(-|t_i - t_j| / theta) z_j: those before and the row itself, then those after.
    sum.setZero();
    for (Eigen::Index i = 0; i < z.rows(); ++i) {
      const auto at = static_cast<std::size_t>(i);
      sum = of.decay[at] * sum + of.with_others[at] * z.row(i).transpose();
      all.row(i) += (of.q2 * of.with_others[at]) * sum.transpose();
    }
    sum.setZero();
    for (Eigen::Index i = z.rows() - 1; i > 0; --i) {
      const auto at = static_cast<std::size_t>(i);
      sum = of.decay[at] * (sum + of.with_others[at] * z.row(i).transpose());
      all.row(i - 1) += (of.q2 * of.with_others[at - 1]) * sum.transpose();
    }
  }
  return all;
}

Eigen::MatrixXd scatter_of(const Eigen::MatrixXd& columns, const ErrorRows& rows,
                           const std::vector<WeightedNoise>& noises) {
  Eigen::MatrixXd scatter(columns.cols(), columns.cols());
  scatter.triangularView<Eigen::Lower>() = columns.transpose() * spread_of(columns, rows, noises);
  return scatter.selfadjointView<Eigen::Lower>();
}

Eigen::MatrixXd covariance_of(const ErrorRows& rows, const std::vector<Eigen::Index>& which, const Noise& noise) {
  const auto n = static_cast<Eigen::Index>(which.size());
  const double q2 = noise.correlated_um * noise.correlated_um, w2 = noise.white_um * noise.white_um;
  Eigen::MatrixXd covariance(n, n);
  std::vector<double> with_others(which.size());
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Index row = which[static_cast<std::size_t>(i)];
    const MeanOfRow mean = mean_of_row(rows.count[row], rows.interval_s[row], noise.correlation_time_s);
    const double others = mean.with_others;
    with_others[static_cast<std::size_t>(i)] = others;
    covariance(i, i) = q2 * mean.variance + w2 / rows.count[row] + kLeastVariance;
    for (Eigen::Index j = 0; j < i; ++j) {
      const double apart_s = std::abs(rows.time_s[row] - rows.time_s[which[static_cast<std::size_t>(j)]]);
      covariance(i, j) = covariance(j, i) =
          q2 * others * with_others[static_cast<std::size_t>(j)] * std::exp(-apart_s / noise.correlation_time_s);
    }
  }
  return covariance;
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

QuietRows quiet_rows(const ErrorRows& rows, const Eigen::MatrixXd& columns) {
  const std::vector<Eigen::Index> joined = joined_row_of(rows);
  Eigen::Index n = 0;
  for (const Eigen::Index row : joined) n = std::max(n, row + 1);
  QuietRows quiet;
  ErrorRows& of = quiet.rows;
  of.count = of.time_s = of.angle_rad = of.interval_s = of.deviation_um = Eigen::VectorXd::Zero(n);
  of.recording.resize(static_cast<std::size_t>(n));
  of.recordings = rows.recordings;
  quiet.columns = Eigen::MatrixXd::Zero(n, columns.cols());
  for (Eigen::Index i = 0; i < rows.size(); ++i) {
    const Eigen::Index row = joined[static_cast<std::size_t>(i)];
    if (row < 0) continue;
    of.count[row] += rows.count[i];
    of.time_s[row] += rows.count[i] * rows.time_s[i];
    of.angle_rad[row] += rows.count[i] * rows.angle_rad[i];
    of.deviation_um[row] += rows.count[i] * rows.deviation_um[i];
    of.interval_s[row] = rows.interval_s[i];
    of.recording[static_cast<std::size_t>(row)] = rows.recording[static_cast<std::size_t>(i)];
    quiet.columns.row(row) += rows.count[i] * columns.row(i);
  }
  for (Eigen::VectorXd* sum : {&of.time_s, &of.angle_rad, &of.deviation_um}) *sum = sum->cwiseQuotient(of.count);
  quiet.columns.array().colwise() /= of.count.array();
  return quiet;
}

Eigen::VectorXd excess_of(const ErrorRows& rows, const Eigen::VectorXd& residual) {
  // Of the four reversals each, and of all rows that are near none.
  constexpr std::size_t kReversals = 4;
  const auto place_of = [&](Eigen::Index i) {
    if (rows.from_reversal_deg[i] > kNearReversal_deg) return kReversals;
    return static_cast<std::size_t>(std::llround(deg_from_rad(rows.angle_rad[i]) / 90.0) % 4 + 4) % kReversals;
  };
  std::array<double, kReversals + 1> squares{}, count{};
  for (Eigen::Index i = 0; i < rows.size(); ++i) {
    if (rows.from_reversal_deg[i] <= kAtReversal_deg) continue;
    squares[place_of(i)] += rows.count[i] * residual[i] * residual[i];
    count[place_of(i)] += rows.count[i];
  }
  Eigen::VectorXd excess = Eigen::VectorXd::Ones(rows.size());
  if (!(squares[kReversals] > 0.0)) return excess;
  const double quiet = squares[kReversals] / count[kReversals];
  for (Eigen::Index i = 0; i < rows.size(); ++i) {
    const std::size_t place = place_of(i);
    const double ratio = place == kReversals ? 1.0 : squares[place] / count[place] / quiet;
    if (ratio >= kClearExcess) excess[i] = std::sqrt(ratio);
  }
  return excess;
}

}  // namespace ballbar
