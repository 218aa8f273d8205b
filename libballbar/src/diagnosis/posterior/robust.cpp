#include "diagnosis/posterior/robust.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "ballbar/numerics/order_statistic.hpp"
#include "diagnosis/evidence/evidence.hpp"
#include "diagnosis/thresholds.hpp"
#include "noise/whitening.hpp"

namespace ballbar {
namespace {

constexpr double kFreedom = 4.0;              // nu of Student's t
constexpr double kOutlier = 2.0;              // (r^2 + nu) / (nu + 1) of a white innovation r
constexpr std::size_t kFewestForLevels = 30;  // readings
constexpr std::size_t kRowsOfLevel = 3;       // on either side of a jump
constexpr std::size_t kRowsOfTrend = 9;       // likewise, of the trend: a jump shows in fewer than half of them
constexpr double kUsualShare = 0.85;          // of the steps that are no jumps
constexpr double kSharp = 0.5;                // of a jump from one row to the next
constexpr double kJumpOff = 5.0;              // usual changes
constexpr std::size_t kFewestLevels = 3;
constexpr std::size_t kMostLevels = 80;

double median_of(std::vector<double> values) { return values.empty() ? 0.0 : median(std::move(values)); }

// The median difference of neighbours among the values that occur.
double resolution_of_readings(const Eigen::VectorXd& y) {
  std::vector<double> sorted(y.begin(), y.end());
  std::sort(sorted.begin(), sorted.end());
  std::vector<double> differences;
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    const double difference = sorted[i] - sorted[i - 1];
    if (difference > 1e-9 * (sorted.back() - sorted.front())) differences.push_back(difference);
  }
  return median_of(std::move(differences));
}

// Each value less the median of those about it: what a slow drift does from row to row is no jump.
std::vector<double> less_the_trend(const std::vector<double>& steps) {
  std::vector<double> result;
  result.reserve(steps.size());
  for (std::size_t k = 0; k < steps.size(); ++k) {
    const std::size_t first = k < kRowsOfTrend ? 0 : k - kRowsOfTrend;
    const std::size_t end = std::min(steps.size(), k + kRowsOfTrend + 1);
    result.push_back(steps[k] - median_of({steps.begin() + static_cast<std::ptrdiff_t>(first),
                                           steps.begin() + static_cast<std::ptrdiff_t>(end)}));
  }
  return result;
}

LinearSolution solution_beside(const Problem& problem, const Variant& variant, const Point& point) {
  return linear_solution(gram_of(point.filter, variant.pool), variant.line, problem.known);
}

Eigen::VectorXd residual_of(const Variant& variant, const LinearSolution& solution) {
  Eigen::VectorXd residual = variant.pool.col(0);
  for (std::size_t k = 0; k < variant.line.columns.size(); ++k)
    residual -= solution.coefficients[static_cast<Eigen::Index>(k)] * variant.pool.col(variant.line.columns[k]);
  return residual;
}

}  // namespace

Eigen::VectorXd residual_beside(const Problem& problem, const Variant& variant, const Point& point) {
  return residual_of(variant, solution_beside(problem, variant, point));
}

bool weigh_down_outliers(Problem& problem, const Variant& variant, const Point& point) {
  if (!problem.tuning.student_t) return false;
  const LinearSolution solution = solution_beside(problem, variant, point);
  const Eigen::VectorXd r = whitened(point.filter, residual_of(variant, solution)) / std::sqrt(solution.variance);
  if (!has_heavy_tails(r)) return false;
  bool any = false;
  for (std::size_t row = 0; row < problem.time_s.size(); ++row) {
    const double factor = (std::pow(r[static_cast<Eigen::Index>(row)], 2) + kFreedom) / (kFreedom + 1.0);
    if (factor < kOutlier) continue;
    problem.relative_variance[row] *= factor;
    any = true;
  }
  return any;
}

std::vector<LevelJump> level_jumps(const Problem& problem, const Eigen::VectorXd& residual_um) {
  if (!problem.tuning.level_jumps) return {};
  std::vector<std::size_t> known;
  std::vector<double> r;
  for (std::size_t i = 0; i < problem.time_s.size(); ++i) {
    if (problem.stated_variance[i] > 0.0) continue;
    known.push_back(i);
    r.push_back(residual_um[static_cast<Eigen::Index>(i)]);
  }
  if (known.size() < kFewestForLevels || !std::is_sorted(problem.time_s.begin(), problem.time_s.end())) return {};
  // The mean of a few rows less that of the rows before.
  std::vector<double> steps(r.size(), 0.0), sizes;
  const auto mean_from = [&](std::size_t first) {
    return std::accumulate(r.begin() + static_cast<std::ptrdiff_t>(first),
                           r.begin() + static_cast<std::ptrdiff_t>(first + kRowsOfLevel), 0.0) /
           static_cast<double>(kRowsOfLevel);
  };
  for (std::size_t k = kRowsOfLevel; k + kRowsOfLevel <= r.size(); ++k) {
    steps[k] = mean_from(k) - mean_from(k - kRowsOfLevel);
  }
  steps = less_the_trend(steps);
  for (std::size_t k = kRowsOfLevel; k + kRowsOfLevel <= r.size(); ++k) sizes.push_back(std::abs(steps[k]));
  std::vector<double> sorted = sizes;
  std::sort(sorted.begin(), sorted.end());
  const auto usual = static_cast<std::size_t>(kUsualShare * static_cast<double>(sorted.size()));
  const double mean = std::accumulate(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(usual), 0.0) /
                      static_cast<double>(std::max<std::size_t>(1, usual));
  // Of a normal distribution: the median of the sizes is 0.67 sigma, the mean of the smaller 85 % 0.55 sigma.
  const double sigma = std::max({sorted[sorted.size() / 2] / 0.67, mean / 0.55, resolution_of_readings(problem.y)});
  std::vector<LevelJump> jumps;
  for (std::size_t k = kRowsOfLevel; k + kRowsOfLevel <= r.size(); ++k) {
    const double size = std::abs(steps[k]);
    if (!(size > kJumpOff * sigma) || std::abs(r[k] - r[k - 1]) < kSharp * size) continue;
    bool is_largest = true;
    for (std::size_t j = k - kRowsOfLevel; j <= k + kRowsOfLevel && j < steps.size(); ++j)
      is_largest = is_largest && std::abs(steps[j]) <= size;
    if (is_largest) jumps.push_back({known[k], size});
  }
  if (jumps.size() < kFewestLevels) return {};
  std::stable_sort(jumps.begin(), jumps.end(),
                   [](const LevelJump& a, const LevelJump& b) { return a.size_um > b.size_um; });
  if (jumps.size() > kMostLevels) jumps.resize(kMostLevels);
  return jumps;
}

}  // namespace ballbar
