#include "diagnosis/posterior/robust.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "ballbar/numerics/order_statistic.hpp"
#include "diagnosis/evidence/evidence.hpp"
#include "diagnosis/thresholds.hpp"

namespace ballbar {
namespace {

constexpr double kFreedom = 4.0;            // nu of Student's t
constexpr std::size_t kHampelReach = 3;     // rows on either side
constexpr double kHampelOff = 6.0;          // scaled median deviations
constexpr double kFarOff = 20.0;            // of the same factor: such a reading is set aside, about 10 sigma
constexpr double kOutlier = 2.0;            // (r^2 + nu) / (nu + 1) of a white innovation r
constexpr double kJumpOff = 6.0;            // usual changes
constexpr std::size_t kFewestLevels = 3;
constexpr std::size_t kMostLevels = 80;
constexpr double kMadToSigma = 1.4826;

double median_of(std::vector<double> values) { return values.empty() ? 0.0 : median(std::move(values)); }

std::vector<double> changes_of(const Eigen::VectorXd& values) {
  std::vector<double> changes;
  for (Eigen::Index i = 1; i < values.size(); ++i) changes.push_back(std::abs(values[i] - values[i - 1]));
  return changes;
}

// The least difference of two readings that occurs.
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
  const LinearSolution solution =
      linear_solution(gram_of(point.filter, variant.pool), variant.line, problem.known);
  Eigen::VectorXd residual = variant.pool.col(0);
  for (std::size_t k = 0; k < variant.line.columns.size(); ++k)
    residual -= solution.coefficients[static_cast<Eigen::Index>(k)] * variant.pool.col(variant.line.columns[k]);
  return residual;
}

bool weigh_down_outliers(Problem& problem, const Variant& variant, const Point& point) {
  const LinearSolution solution = linear_solution(gram_of(point.filter, variant.pool), variant.line, problem.known);
  const Eigen::VectorXd r =
      whitened(point.filter, residual_beside(problem, variant, point)) / std::sqrt(solution.variance);
  if (!has_heavy_tails(r)) return false;
  bool any = false;
  for (Eigen::Index i = 0; i < r.size(); ++i) {
    const double factor = (r[i] * r[i] + kFreedom) / (kFreedom + 1.0);
    if (factor < kOutlier) continue;
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
  Eigen::VectorXd r = residual_um;
  const auto n = static_cast<std::size_t>(r.size());
  std::vector<std::size_t> known;
  for (std::size_t i = 0; i < n; ++i) {
    if (problem.stated_variance[i] == 0.0 && problem.relative_variance[i] < 1.0 / 0.3) known.push_back(i);
  }
  if (known.size() < 30 || !std::is_sorted(problem.time_s.begin(), problem.time_s.end())) return {};
  Eigen::VectorXd of_known(static_cast<Eigen::Index>(known.size()));
  for (std::size_t k = 0; k < known.size(); ++k)
    of_known[static_cast<Eigen::Index>(k)] = r[static_cast<Eigen::Index>(known[k])];
  std::vector<double> changes = changes_of(of_known);
  std::vector<double> sorted = changes;
  std::sort(sorted.begin(), sorted.end());
  const auto usual = static_cast<std::size_t>(0.85 * static_cast<double>(sorted.size()));
  const double mean = std::accumulate(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(usual), 0.0) /
                      static_cast<double>(std::max<std::size_t>(1, usual));
  const double sigma = std::max({sorted[sorted.size() / 2] / 0.67, mean / 0.55, resolution_of_readings(problem.y)});
  std::vector<LevelJump> jumps;
  for (std::size_t k = 0; k < changes.size(); ++k) {
    if (changes[k] > kJumpOff * sigma) jumps.push_back({known[k + 1], changes[k]});
  }
  if (jumps.size() < kFewestLevels) return {};
  std::stable_sort(jumps.begin(), jumps.end(),
                   [](const LevelJump& a, const LevelJump& b) { return a.size_um > b.size_um; });
  if (jumps.size() > kMostLevels) jumps.resize(kMostLevels);
  return jumps;
}

}  // namespace ballbar
