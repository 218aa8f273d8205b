#include "machine_errors/error_noise.hpp"

#include <Eigen/Core>
#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
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

struct RestrictedEstimate {
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
RestrictedEstimate restricted(const RestrictedLikelihood& likelihood, const LinearFilter& filter, double memory_s,
                              double white, Eigen::Index rows) {
  const LinearFilter::Sums sums = likelihood.sums(filter, {white * white, 1.0, memory_s});
  const auto freedom = static_cast<double>(std::max<Eigen::Index>(rows - likelihood.columns(), 1));
  RestrictedEstimate result;
  result.variance = std::max(sums.squares / freedom, kLeast_um * kLeast_um);
  result.log_likelihood = -0.5 * (freedom * std::log(result.variance) + sums.log_variances);
  return result;
}

// Of these memories and kWhiteOfCorrelated, from the middle on: all that lie beside one with a weight. Weights are
// logarithms of the likelihood. `known`: of kUsualWhite, for one memory.
std::vector<WeightedNoise> likely_noises(const ErrorRows& rows, const RestrictedLikelihood& likelihood,
                                         const std::vector<double>& memories_s, double known_memory_s,
                                         const RestrictedEstimate& known) {
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
    const bool is_known = white == kUsualWhite && memories_s[memory] == known_memory_s;
    if (!is_known && !filters[memory]) filters[memory] = filter_of(rows, memories_s[memory]);
    const RestrictedEstimate found =
        is_known ? known
                 : restricted(likelihood, *filters[memory], memories_s[memory], kWhiteOfCorrelated[white], rows.size());
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

// Orthonormal columns that span these, whose own size, of which some may be taken off, is 1.
Eigen::MatrixXd span_of(const Eigen::MatrixXd& columns) {
  if (columns.size() == 0) return columns.leftCols(0);
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> parts(columns.rows(), columns.cols());
  parts.compute(columns);
  parts.setThreshold(kLeastOfSpan / std::max(parts.maxPivot(), kLeastOfSpan));
  const Eigen::Index rank = parts.rank();
  // X P = Q R
  Eigen::MatrixXd span = columns(Eigen::all, parts.colsPermutation().indices().head(rank));
  parts.matrixR().topLeftCorner(rank, rank).triangularView<Eigen::Upper>().solveInPlace<Eigen::OnTheRight>(span);
  return span;
}

// The same of all columns, first of those that one recording alone has: they stay 0 in the others.
Eigen::MatrixXd span_of(const Eigen::MatrixXd& columns, const std::vector<std::size_t>& starts) {
  Eigen::MatrixXd shared = columns;
  for (Eigen::Index k = 0; k < shared.cols(); ++k) {
    const double size = shared.col(k).norm();
    if (size > 0.0) shared.col(k) /= size;
  }
  std::vector<Eigen::Index> left(static_cast<std::size_t>(columns.cols()));
  std::iota(left.begin(), left.end(), Eigen::Index{0});
  Eigen::MatrixXd span(columns.rows(), columns.cols());
  Eigen::Index rank = 0;
  for (std::size_t k = 0; k < starts.size(); ++k) {
    const auto first = static_cast<Eigen::Index>(starts[k]);
    const Eigen::Index end = k + 1 < starts.size() ? static_cast<Eigen::Index>(starts[k + 1]) : columns.rows();
    const auto is_own = [&](Eigen::Index column) {
      return shared.col(column).head(first).isZero(0.0) && shared.col(column).tail(columns.rows() - end).isZero(0.0);
    };
    const auto own = std::stable_partition(left.begin(), left.end(), [&](Eigen::Index c) { return !is_own(c); });
    const Eigen::MatrixXd basis =
        span_of(shared(Eigen::seq(first, end - 1), std::vector<Eigen::Index>(own, left.end())));
    left.erase(own, left.end());
    auto rows = shared.middleRows(first, end - first);
    rows -= basis * (basis.transpose() * rows);
    span.middleCols(rank, basis.cols()).setZero();
    span.block(first, rank, end - first, basis.cols()) = basis;
    rank += basis.cols();
  }
  const Eigen::MatrixXd basis = span_of(shared(Eigen::all, left));
  span.middleCols(rank, basis.cols()) = basis;
  return span.leftCols(rank + basis.cols());
}

}  // namespace

std::vector<WeightedNoise> error_noise(const ErrorRows& rows, const Eigen::MatrixXd& columns) {
  // Of what the columns span: on a short arc some are the sum of others, and their X' V^-1 X has no root.
  const std::vector<std::size_t> starts = starts_of(rows);
  const RestrictedLikelihood likelihood({rows.deviation_um.data(), rows.recording.size()}, span_of(columns, starts),
                                        starts);
  const std::array<double, kMemories> memories = memories_s(rows);
  std::size_t best = 0;
  RestrictedEstimate likeliest{-std::numeric_limits<double>::infinity()};
  for (std::size_t k = 0; k < memories.size(); ++k) {
    const RestrictedEstimate one =
        restricted(likelihood, filter_of(rows, memories[k]), memories[k], kWhiteOfCorrelated[kUsualWhite], rows.size());
    if (one.log_likelihood > likeliest.log_likelihood) likeliest = one, best = k;
  }
  std::vector<double> fine_s;
  fine_s.reserve(kFineMemories.size());
  for (const double times : kFineMemories) {
    if (times * memories[best] <= 1.0001 * memories.back()) fine_s.push_back(times * memories[best]);
  }
  std::vector<WeightedNoise> noises = likely_noises(rows, likelihood, fine_s, memories[best], likeliest);
  const auto likelier = [](const WeightedNoise& a, const WeightedNoise& b) { return a.weight > b.weight; };
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
  constexpr Eigen::Index kGroup = 8;  // columns that are taken together, so that their sums stay in registers
  using Group = Eigen::Array<double, 1, kGroup>;
  Eigen::Array<double, Eigen::Dynamic, kGroup, Eigen::RowMajor> z(columns.rows(), kGroup), correlated = z;
  Eigen::MatrixXd all(columns.rows(), columns.cols());  // V Z
  for (Eigen::Index first = 0; first < columns.cols(); first += kGroup) {
    const Eigen::Index together = std::min(kGroup, columns.cols() - first);
    z.setZero();
    z.leftCols(together) = columns.middleCols(first, together);
    correlated = z.colwise() * own;
    for (const Spread& of : spreads) {
      // sum over j of k_j exp(-|t_i - t_j| / theta) z_j: those before and the row itself, then those after.
      Group sum = Group::Zero();
      for (Eigen::Index i = 0; i < z.rows(); ++i) {
        const auto at = static_cast<std::size_t>(i);
        sum = of.decay[at] * sum + of.with_others[at] * z.row(i);
        correlated.row(i) += (of.q2 * of.with_others[at]) * sum;
      }
      sum.setZero();
      for (Eigen::Index i = z.rows() - 1; i > 0; --i) {
        const auto at = static_cast<std::size_t>(i);
        sum = of.decay[at] * (sum + of.with_others[at] * z.row(i));
        correlated.row(i - 1) += (of.q2 * of.with_others[at - 1]) * sum;
      }
    }
    all.middleCols(first, together) = correlated.leftCols(together);
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

}  // namespace ballbar
