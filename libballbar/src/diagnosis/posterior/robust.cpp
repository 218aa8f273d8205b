#include "diagnosis/posterior/robust.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "ballbar/numerics/order_statistic.hpp"
#include "diagnosis/evidence/evidence.hpp"
#include "diagnosis/thresholds.hpp"

namespace ballbar {
namespace {

constexpr double kFreedom = 4.0;              // nu of Student's t
constexpr std::size_t kHampelReach = 3;       // rows on either side
constexpr double kHampelOff = 6.0;            // scaled median deviations
constexpr double kStays = 0.5;                // share of a change that the next row has as well
constexpr double kFarOff = 20.0;              // of the same factor: such a reading is set aside, about 10 sigma
constexpr double kOutlier = 2.0;              // (r^2 + nu) / (nu + 1) of a white innovation r
constexpr std::size_t kFewestForLevels = 30;  // readings
constexpr std::size_t kRowsOfLevel = 3;       // on either side of a jump
constexpr double kUsualShare = 0.85;          // of the steps that are no jumps
constexpr double kSharp = 0.5;                // of a jump from one row to the next
constexpr double kJumpOff = 6.0;              // usual changes
constexpr std::size_t kFewestLevels = 3;
constexpr std::size_t kMostLevels = 80;
constexpr double kMadToSigma = 1.4826;

double median_of(std::vector<double> values) { return values.empty() ? 0.0 : median(std::move(values)); }

std::vector<double> changes_of(const Eigen::VectorXd& values) {
  std::vector<double> changes;
  for (Eigen::Index i = 1; i < values.size(); ++i) changes.push_back(std::abs(values[i] - values[i - 1]));
  return changes;
}

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

std::vector<std::size_t> far_readings(const Eigen::VectorXd& y) {
  const auto n = static_cast<std::size_t>(y.size());
  std::vector<double> off(n, 0.0);
  std::vector<std::size_t> far;
  if (n < 4 * kHampelReach) return far;
  for (std::size_t i = 0; i < n; ++i) {
    std::vector<double> about;
    for (std::size_t k = 0; k < 2 * kHampelReach + 1; ++k) {
      const std::size_t row = std::min(n - 1, i + k < kHampelReach ? 0 : i + k - kHampelReach);
      about.push_back(y[static_cast<Eigen::Index>(row)]);
    }
    off[i] = y[static_cast<Eigen::Index>(i)] - median(std::move(about));
  }
  std::vector<double> sizes(n);
  for (std::size_t i = 0; i < n; ++i) sizes[i] = std::abs(off[i]);
  const double sigma = std::max(kMadToSigma * median_of(sizes), median_of(changes_of(y)) / 0.954);
  if (!(sigma > 0.0)) return far;
  for (std::size_t i = 0; i < n; ++i) {
    if (sizes[i] > kHampelOff * sigma) far.push_back(i);
  }
  return far;
}

Eigen::VectorXd residual_beside(const Problem& problem, const Variant& variant, const Point& point) {
  return residual_of(variant, solution_beside(problem, variant, point));
}

bool weigh_down_outliers(Problem& problem, const Variant& variant, const Point& point) {
  const LinearSolution solution = solution_beside(problem, variant, point);
  const Eigen::VectorXd residual = residual_of(variant, solution);
  const Eigen::VectorXd r = whitened(point.filter, residual) / std::sqrt(solution.variance);
  // A jump after which the residual stays is no reading far from the others.
  const auto stays = [&](Eigen::Index i) {
    if (i == 0 || i + 1 == residual.size()) return false;
    return (residual[i + 1] - residual[i - 1]) / (residual[i] - residual[i - 1]) > kStays;
  };
  if (!has_heavy_tails(r)) return false;
  bool any = false;
  for (Eigen::Index i = 0; i < r.size(); ++i) {
    const double factor = (r[i] * r[i] + kFreedom) / (kFreedom + 1.0);
    if (factor < kOutlier || stays(i)) continue;
    const auto row = static_cast<std::size_t>(i);
    if (factor > kFarOff && problem.stated_variance[row] == 0.0) {
      problem.stated_variance[row] = kUnknownVariance;
      ++problem.far_readings;
    }
    problem.relative_variance[row] *= factor;
    problem.shock[row] *= factor;
    any = true;
  }
  return any;
}

std::vector<LevelJump> level_jumps(const Problem& problem, const Eigen::VectorXd& residual_um) {
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
    sizes.push_back(std::abs(steps[k]));
  }
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
