#include "history/scatter.hpp"

#include <algorithm>
#include <boost/math/special_functions/digamma.hpp>
#include <boost/math/special_functions/trigamma.hpp>
#include <cmath>

#include "ballbar/history/history.hpp"
#include "ballbar/internal/numerics/parallel.hpp"
#include "history/robust_fit.hpp"
#include "history/tail_table.hpp"
#include "numerics/median.hpp"
#include "numerics/root.hpp"

namespace ballbar {
namespace {

constexpr double kDegreesOfDifference =
    0.6;  // of one difference for a scatter, where a normal value about a known mean has 1
constexpr double kLeastPriorDegrees = 0.5, kMostPriorDegrees = 30.0;
constexpr std::size_t kSeriesOfPrior = 4;
constexpr double kSquareOfClipped = 0.9205;  // of a standard normal number, clipped at kHuberClip

double usual_sigma(const QuantitySeries& series) {
  std::vector<double> known;
  for (const double sigma : series.sigma) {
    if (std::isfinite(sigma)) known.push_back(sigma);
  }
  return known.empty() ? 0.0 : median(std::move(known));
}

// Half the smallest step between different values: of rounded ones, what rounding hides.
double resolution_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  double least = 0.0;
  for (std::size_t i = 1; i < values.size(); ++i) {
    const double step = values[i] - values[i - 1];
    if (step > 0.0 && (least == 0.0 || step < least)) least = step;
  }
  return least / std::sqrt(12.0);
}

// From successive values, so that neither steps nor trends count; large differences count as 2.5 usual ones.
double scatter_of_differences(const std::vector<double>& values) {
  std::vector<double> difference;
  double sum = 0.0;
  for (std::size_t i = 1; i < values.size(); ++i) {
    difference.push_back(std::abs(values[i] - values[i - 1]) / std::sqrt(2.0));
    sum += difference.back();
  }
  double usual = kSigmaOfDeviation * median(difference);
  if (usual == 0.0) usual = 1.2533 * sum / static_cast<double>(difference.size());
  constexpr double kMost = 2.5;
  constexpr double kSquareKept = 0.974;  // of a standard normal number's, clipped there
  double squares = 0.0;
  for (const double one : difference) squares += std::pow(std::min(one, kMost * usual), 2);
  return std::sqrt(squares / static_cast<double>(difference.size()) / kSquareKept);
}

double degrees_of(const QuantitySeries& series) {
  return std::max(1.0, kDegreesOfDifference * static_cast<double>(series.value.size() - 1));
}

// Mean and degrees of freedom of the scatters' logarithm over machines; medians, as some machines step or wear.
void moderate(const AllSeries& all, const std::vector<std::size_t>& members, std::vector<SeriesScatter>& scatter) {
  std::vector<double> logs, own;
  for (const std::size_t i : members) {
    if (scatter[i].s <= 0.0) continue;
    const double half = 0.5 * degrees_of(all.series[i]);
    logs.push_back(2.0 * std::log(scatter[i].s) - boost::math::digamma(half) + std::log(half));
    own.push_back(boost::math::trigamma(half));
  }
  for (const std::size_t i : members) scatter[i].degrees = degrees_of(all.series[i]);
  if (logs.size() < kSeriesOfPrior) return;
  const double middle = median(logs);
  std::vector<double> deviation;
  deviation.reserve(logs.size());
  for (const double one : logs) deviation.push_back(std::abs(one - middle));
  const double excess = std::pow(kSigmaOfDeviation * median(deviation), 2) - median(own);
  const auto is_below = [&](double degrees) { return boost::math::trigamma(0.5 * degrees) > excess; };
  const double d0 = root_between(is_below, kLeastPriorDegrees, kMostPriorDegrees).second;
  const double s02 = std::exp(middle + boost::math::digamma(0.5 * d0) - std::log(0.5 * d0));
  for (const std::size_t i : members) {
    const double d = degrees_of(all.series[i]);
    scatter[i].s = std::sqrt((d0 * s02 + d * scatter[i].s * scatter[i].s) / (d0 + d));
    scatter[i].degrees = d0 + d;
    scatter[i].of_machines = true;
  }
}

// The tails and correlation of one series: scores about a line, or about its step or season if these are significant.
struct Scores {
  std::vector<double> about_curve;
  std::array<double, kRunLengths> square_of_run{};  // mean square of the mean of j, times j; 0: too short for it
};

Scores scores_of(const QuantitySeries& series, double s) {
  Scores scores;
  const std::size_t n = series.value.size();
  constexpr std::size_t kFewestTests = 5;
  if (n < kFewestTests || s <= 0.0) return scores;
  const RobustFit line = robust_fit(trend_columns(series.time_s), series.value, scatters_of(series, s));
  const double kept = std::sqrt(static_cast<double>(n) / static_cast<double>(n - 2));
  std::vector<double> sum{0.0};
  for (const double z : line.scores) {
    scores.about_curve.push_back(kept * z);
    sum.push_back(sum.back() + clipped(z, kHuberClip));
  }
  for (std::size_t k = 0; k < kRunLengths; ++k) {
    const std::size_t j = kRunLength[k];
    if (j > 1 && 4 * j > n) break;
    double squares = 0.0;
    for (std::size_t i = 0; i + j <= n; ++i) squares += std::pow(sum[i + j] - sum[i], 2);
    // What a line through independent values leaves of the mean of j.
    const double share = static_cast<double>(j) / static_cast<double>(n);
    const double left = 1.0 - share - share * (1.0 - share) * (1.0 - share);
    scores.square_of_run[k] =
        squares / static_cast<double>(n - j + 1) / static_cast<double>(j) / left / kSquareOfClipped;
  }
  return scores;
}

// Median over series of the mean square of runs; that of a mean of few runs lies below its mean (Wilson and Hilferty).
struct Memory {
  std::array<double, kRunLengths> ratio{};
  std::array<double, kRunLengths> series{};  // how many it is from
};

Memory memory_of(const AllSeries& all, const std::vector<Scores>& scores, const std::vector<std::size_t>& members) {
  Memory memory;
  for (std::size_t k = 0; k < kRunLengths; ++k) {
    std::vector<double> squares;
    for (const std::size_t i : members) {
      if (scores[i].square_of_run[k] <= 0.0) continue;
      const double runs = 1.3 * static_cast<double>(all.series[i].value.size()) / static_cast<double>(kRunLength[k]);
      squares.push_back(scores[i].square_of_run[k] / std::pow(1.0 - 2.0 / (9.0 * runs), 3));
    }
    memory.series[k] = static_cast<double>(squares.size());
    if (!squares.empty()) memory.ratio[k] = median(std::move(squares));
  }
  return memory;
}

double memory_at(const std::array<double, kRunLengths>& ratio, double j) {
  for (std::size_t k = 1; k < kRunLengths; ++k) {
    const auto low = static_cast<double>(kRunLength[k - 1]), high = static_cast<double>(kRunLength[k]);
    if (j > high) continue;
    const double share = std::clamp((j - low) / (high - low), 0.0, 1.0);
    return (1.0 - share) * ratio[k - 1] + share * ratio[k];
  }
  return ratio.back();
}

// With few machines the estimate for one quantity is combined with that of all quantities, and with a typical
// correlation. For runs longer than any in the tests it rises further by the same amount with every doubling.
std::array<double, kRunLengths> moderated(const Memory& own, const Memory& of_all) {
  constexpr double kWeightOfAll = 6.0, kUsual = 0.14;  // ln of the ratio
  std::array<double, kRunLengths> ratio{};
  const auto pulled = [](double found, double weight, double usual) {
    return weight > 0.0 ? (weight * std::log(found) + kWeightOfAll * usual) / (weight + kWeightOfAll) : usual;
  };
  for (std::size_t k = 0; k < kRunLengths; ++k) {
    if (k > 0 && of_all.series[k] == 0.0) {
      const double half = 0.5 * static_cast<double>(kRunLength[k]);
      ratio[k] = memory_at(ratio, half) + std::max(0.0, memory_at(ratio, half) - memory_at(ratio, 0.5 * half));
      ratio[k] = std::max(ratio[k], ratio[k - 1]);
      continue;
    }
    const double all = pulled(of_all.ratio[k], of_all.series[k], kUsual);
    ratio[k] = std::max(1.0, std::exp(pulled(own.ratio[k], own.series[k], all)));
  }
  return ratio;
}

}  // namespace

std::vector<double> scatters_of(const QuantitySeries& series, double s) {
  const double usual = usual_sigma(series);
  std::vector<double> scatter(series.value.size(), s);
  for (std::size_t i = 0; i < scatter.size(); ++i) {
    const double sigma = series.sigma[i];
    if (sigma > usual) scatter[i] = std::sqrt(s * s + sigma * sigma - usual * usual);
  }
  return scatter;
}

Scatter scatter_of(const AllSeries& all) {
  Scatter scatter;
  const std::size_t count = all.series.size();
  scatter.series.resize(count);
  in_parallel(count, [&](std::size_t i) {
    const QuantitySeries& series = all.series[i];
    if (series.value.size() < kTestsOfTrend) return;
    constexpr double kLeast = 0.7;  // of the sigma that the fits state
    scatter.series[i].s =
        std::max({scatter_of_differences(series.value), kLeast * usual_sigma(series), resolution_of(series.value)});
  });
  std::vector<std::vector<std::size_t>> members(all.families);
  std::vector<std::size_t> everyone;
  for (std::size_t i = 0; i < count; ++i) {
    if (all.series[i].value.size() < kTestsOfTrend) continue;
    members[all.series[i].family].push_back(i);
    everyone.push_back(i);
  }
  in_parallel(members.size(), [&](std::size_t f) { moderate(all, members[f], scatter.series); });
  std::vector<Scores> scores(count);
  in_parallel(count, [&](std::size_t i) {
    if (all.series[i].value.size() >= kTestsOfTrend) scores[i] = scores_of(all.series[i], scatter.series[i].s);
  });
  const Memory of_all = memory_of(all, scores, everyone);
  TailCounts all_counts;
  for (const Scores& one : scores) all_counts.add(one.about_curve);
  scatter.families.resize(all.families);
  in_parallel(members.size(), [&](std::size_t f) {
    if (members[f].empty()) return;
    scatter.families[f].memory_of = moderated(memory_of(all, scores, members[f]), of_all);
    TailCounts counts;
    for (const std::size_t i : members[f]) counts.add(scores[i].about_curve);
    scatter.families[f].tail = tails_of(counts, all_counts);
    scatter.families[f].variance_of_score = variance_of(scatter.families[f].tail.front());
  });
  return scatter;
}

double FamilyScatter::memory(double j) const { return memory_at(memory_of, j); }

// Subtracting a line removes some of the correlated scatter as well; worked out from autoregressive scatter and from
// scatter that stays for 3 to 8 tests.
double FamilyScatter::memory_beyond(double j) const {
  constexpr double kGoesOn = 2.5;
  return memory(j) + kGoesOn * std::max(0.0, memory(j) - memory(0.5 * j));
}

double FamilyScatter::chance_of_mean(std::size_t j, double mean) const {
  // j correlated values are worth fewer.
  const double worth = static_cast<double>(j) / memory(static_cast<double>(j));
  const auto values = static_cast<std::size_t>(std::clamp(std::floor(worth + 0.5), 1.0, static_cast<double>(j)));
  return chance_of_sum(tail[values - 1], std::abs(mean) * static_cast<double>(values));
}

}  // namespace ballbar
