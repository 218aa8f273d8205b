#include "machine_errors/error_noise.hpp"

#include <Eigen/Core>
#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
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

// Of the part with a memory, for q = 1, in a mean over a row: what it shares with others (k), and its variance.
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

struct Restricted {
  double log_likelihood = 0.0;
  double variance = 0.0;  // s^2: of q^2 = 1
};

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

// For q = 1.
Restricted restricted(const RestrictedLikelihood& likelihood, const LinearFilter& filter, double memory_s, double white,
                      Eigen::Index rows) {
  const LinearFilter::Sums sums = likelihood.sums(filter, {white * white, 1.0, memory_s});
  const auto freedom = static_cast<double>(std::max<Eigen::Index>(rows - likelihood.columns(), 1));
  Restricted result;
  result.variance = std::max(sums.squares / freedom, kLeast_um * kLeast_um);
  result.log_likelihood = -0.5 * (freedom * std::log(result.variance) + sums.log_variances);
  return result;
}

// Of these memories and kWhiteOfCorrelated, from the middle on: all that lie beside one with a weight. Weights are
// logarithms of the likelihood.
std::vector<WeightedNoise> likely_noises(const ErrorRows& rows, const RestrictedLikelihood& likelihood,
                                         const std::vector<double>& memories_s) {
  constexpr std::size_t kWhites = kWhiteOfCorrelated.size();
  std::vector<std::optional<LinearFilter>> filters(memories_s.size());
  std::vector<bool> looked_at(filters.size() * kWhites, false);
  struct Place {
    std::size_t memory = 0, white = 0;
    bool open = true;  // what lies beside it was not looked at
  };
  std::vector<Place> places;
  std::vector<WeightedNoise> noises;
  places.reserve(looked_at.size());
  noises.reserve(looked_at.size());
  const auto look_at = [&](std::size_t memory, std::size_t white) {
    if (looked_at[memory * kWhites + white]) return;
    looked_at[memory * kWhites + white] = true;
    if (!filters[memory]) filters[memory] = filter_of(rows, memories_s[memory]);
    const Restricted found =
        restricted(likelihood, *filters[memory], memories_s[memory], kWhiteOfCorrelated[white], rows.size());
    const double correlated_um = std::sqrt(found.variance);
    const double white_um = kWhiteOfCorrelated[white] * correlated_um;
    noises.push_back({found.log_likelihood, {white_um, correlated_um, memories_s[memory], found.log_likelihood}});
    places.push_back({memory, white});
  };
  look_at(filters.size() / 2, kUsualWhite);
  for (;;) {
    double most = noises.front().weight;
    std::size_t next = noises.size();  // the likeliest that is open
    for (std::size_t k = 0; k < noises.size(); ++k) {
      most = std::max(most, noises[k].weight);
      if (places[k].open && (next == noises.size() || noises[k].weight > noises[next].weight)) next = k;
    }
    if (next == noises.size() || noises[next].weight < most + std::log(kLeastWeight)) return noises;
    places[next].open = false;
    const auto [memory, white, open] = places[next];
    const auto before = [](std::size_t k) { return k - std::min<std::size_t>(k, 1); };
    for (std::size_t m = before(memory); m < std::min(memory + 2, filters.size()); ++m) {
      for (std::size_t w = before(white); w < std::min(white + 2, kWhites); ++w) look_at(m, w);
    }
  }
}

// Orthonormal columns that span these.
Eigen::MatrixXd span_of(const Eigen::MatrixXd& columns) {
  Eigen::MatrixXd scaled = columns;  // in size, so that none is lost to rounding
  for (Eigen::Index k = 0; k < scaled.cols(); ++k) {
    const double size = scaled.col(k).norm();
    if (size > 0.0) scaled.col(k) /= size;
  }
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> parts(scaled.rows(), scaled.cols());
  parts.setThreshold(kLeastOfSpan);
  parts.compute(scaled);
  return parts.householderQ() * Eigen::MatrixXd::Identity(scaled.rows(), parts.rank());
}

}  // namespace

std::vector<WeightedNoise> error_noise(const ErrorRows& rows, const Eigen::MatrixXd& columns) {
  // Of what the columns span: on a short arc some are the sum of others, and their X' V^-1 X has no root.
  const Eigen::MatrixXd span = span_of(columns);
  const RestrictedLikelihood likelihood({rows.deviation_um.data(), rows.recording.size()}, span);
  const std::array<double, kMemories> memories = memories_s(rows);
  std::size_t best = 0;
  double most = -std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < memories.size(); ++k) {
    const double log_likelihood =
        restricted(likelihood, filter_of(rows, memories[k]), memories[k], kWhiteOfCorrelated[kUsualWhite], rows.size())
            .log_likelihood;
    if (log_likelihood > most) most = log_likelihood, best = k;
  }
  std::vector<double> fine_s;
  fine_s.reserve(kFineMemories.size());
  for (const double times : kFineMemories) {
    if (times * memories[best] <= 1.0001 * memories.back()) fine_s.push_back(times * memories[best]);
  }
  std::vector<WeightedNoise> noises = likely_noises(rows, likelihood, fine_s);
  const auto likelier = [](const WeightedNoise& a, const WeightedNoise& b) { return a.weight > b.weight; };
  std::stable_sort(noises.begin(), noises.end(), likelier);
  most = noises.front().weight;
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

Eigen::MatrixXd spread_of(const Eigen::MatrixXd& columns, const ErrorRows& rows,
                          const std::vector<WeightedNoise>& noises) {
  std::map<double, std::pair<double, double>> by_memory;  // q^2 and w^2, each times its weight
  for (const WeightedNoise& one : noises) {
    auto& [q2, w2] = by_memory[one.noise.correlation_time_s];
    q2 += one.weight * one.noise.correlated_um * one.noise.correlated_um;
    w2 += one.weight * one.noise.white_um * one.noise.white_um;
  }
  const RowMajorMatrix z = columns;
  RowMajorMatrix correlated = RowMajorMatrix::Zero(z.rows(), z.cols());  // V Z
  Eigen::RowVectorXd sum(z.cols());
  for (const auto& [memory_s, variances] : by_memory) {
    const auto [q2, w2] = variances;
    const RowMemory memory = row_memory(rows, memory_s);
    const std::vector<double> decay = decays_of(rows, memory_s);
    // sum over j of k_j exp(-|t_i - t_j| / theta) z_j: those before and the row itself, then those after.
    sum.setZero();
    for (Eigen::Index i = 0; i < z.rows(); ++i) {
      const auto at = static_cast<std::size_t>(i);
      const double with_others = memory.with_others[at], own = memory.variance[at] - with_others * with_others;
      sum = decay[at] * sum + with_others * z.row(i);
      correlated.row(i) += (q2 * with_others) * sum + (q2 * own + w2 / rows.count[i]) * z.row(i);
    }
    sum.setZero();
    for (Eigen::Index i = z.rows() - 1; i > 0; --i) {
      const auto at = static_cast<std::size_t>(i);
      sum = decay[at] * (sum + memory.with_others[at] * z.row(i));
      correlated.row(i - 1) += (q2 * memory.with_others[at - 1]) * sum;
    }
  }
  return correlated;
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

}  // namespace ballbar
