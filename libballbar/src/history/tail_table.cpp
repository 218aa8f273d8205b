#include "history/tail_table.hpp"

#include <algorithm>
#include <cmath>

#include "numerics/tails.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kTailSteps = 60;  // kShortRunClip over kTailStep
constexpr double kOfAll = 200.0;        // scores of all quantities that are added to a quantity's own
constexpr double kOfStudent = 40.0;

// Of |t| for t of Student with 4 degrees of freedom, as wide in its middle as a standard normal number.
std::array<double, kTailSteps + 1> student_share() {
  constexpr double kWidth = 0.91;  // 0.6745 over the quartile 0.7407
  std::array<double, kTailSteps + 1> share{};
  const auto beyond = [](double z) { return student_tails(z / kWidth, 4.0); };
  for (std::size_t i = 0; i <= kTailSteps; ++i) {
    const double low = i == 0 ? 0.0 : (static_cast<double>(i) - 0.5) * kTailStep;
    const double high = (static_cast<double>(i) + 0.5) * kTailStep;
    share[i] = (i == 0 ? 1.0 : beyond(low)) - (i == kTailSteps ? 0.0 : beyond(high));
  }
  return share;
}

}  // namespace

void TailCounts::add(std::span<const double> scores) {
  for (const double z : scores) {
    const double step = std::round(std::min(std::abs(z), kShortRunClip) / kTailStep);
    counts[static_cast<std::size_t>(step)] += 1.0;
    total += 1.0;
  }
}

std::array<std::vector<double>, kLongestShortRun> tails_of(const TailCounts& own, const TailCounts& of_all) {
  static const std::array<double, kTailSteps + 1> student = student_share();
  const double weight_of_all = of_all.total > 0.0 ? std::min(1.0, kOfAll / of_all.total) : 0.0;
  const double total = own.total + weight_of_all * of_all.total + kOfStudent;
  // Both sides equal: half of each count above 0 on either.
  std::vector<double> density(2 * kTailSteps + 1, 0.0);
  for (std::size_t i = 0; i <= kTailSteps; ++i) {
    const double share = (own.counts[i] + weight_of_all * of_all.counts[i] + kOfStudent * student[i]) / total;
    density[kTailSteps + i] += 0.5 * share;
    density[kTailSteps - i] += 0.5 * share;
  }
  std::array<std::vector<double>, kLongestShortRun> tails;
  std::vector<double> sum{1.0};
  for (std::size_t k = 0; k < kLongestShortRun; ++k) {
    std::vector<double> next(sum.size() + 2 * kTailSteps, 0.0);
    for (std::size_t i = 0; i < sum.size(); ++i) {
      for (std::size_t j = 0; j < density.size(); ++j) next[i + j] += sum[i] * density[j];
    }
    sum = std::move(next);
    const std::size_t middle = (k + 1) * kTailSteps;
    tails[k].assign(middle + 1, 0.0);
    double above = 0.0;
    for (std::size_t i = middle + 1; i-- > 0;) tails[k][i] = above += sum[middle + i];
  }
  return tails;
}

double variance_of(const std::vector<double>& tail) {
  double sum = 0.0;
  for (std::size_t i = 1; i < tail.size(); ++i) {
    const double share = tail[i] - (i + 1 < tail.size() ? tail[i + 1] : 0.0);
    sum += 2.0 * share * std::pow(static_cast<double>(i) * kTailStep, 2);
  }
  return sum;
}

double chance_of_sum(const std::vector<double>& tail, double sum) {
  const auto step = static_cast<std::size_t>(std::floor(sum / kTailStep + 1e-9));
  return std::min(1.0, 2.0 * tail[std::min(step, tail.size() - 1)]);
}

}  // namespace ballbar
