#include "diagnosis/posterior/robust.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "ballbar/numerics/order_statistic.hpp"
#include "diagnosis/evidence/evidence.hpp"
#include "diagnosis/thresholds.hpp"
#include "noise/whitening.hpp"
#include "numerics/orthonormal.hpp"

namespace ballbar {
namespace {

constexpr double kFreedom = 4.0;              // nu of Student's t
constexpr std::size_t kHampelReach = 3;       // rows on either side
constexpr double kHampelOff = 6.0;            // scaled median deviations
constexpr double kStays = 4.4;                // chi^2: so much more falls by a jump that stays
constexpr double kFarOff = 20.0;              // of the same factor: such a reading is set aside, about 10 sigma
constexpr double kOutlier = 2.0;              // (r^2 + nu) / (nu + 1) of a white innovation r
constexpr std::size_t kFewestForLevels = 30;  // readings
constexpr std::size_t kRowsOfLevel = 3;       // on either side of a jump
constexpr std::size_t kRowsOfTrend = 9;       // likewise, of the trend: a jump shows in fewer than half of them
constexpr double kUsualShare = 0.85;          // of the steps that are no jumps
constexpr double kSharp = 0.5;                // of a jump from one row to the next
constexpr double kJumpOff = 5.0;              // usual changes
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

// What begins at a row far off: a reading alone, a change of the noise that is forgotten within its memory, or a jump
// that stays: it explains more, or so much more that it is certain.
enum class Begins { reading, change, likely_jump, jump };

std::vector<Begins> what_begins(const Problem& problem, const Variant& variant, const Point& point,
                                const std::vector<Eigen::Index>& rows, double variance) {
  std::vector<Begins> result(rows.size(), Begins::change);
  const std::vector<double>& time_s = problem.time_s;
  if (rows.empty() || !std::is_sorted(time_s.begin(), time_s.end())) return result;
  const Covariance& covariance = point.covariance;
  const Eigen::MatrixXd white = whitened(point.filter, variant.pool);
  const Eigen::MatrixXd basis = orthonormal(white(Eigen::all, variant.line.columns));
  const Eigen::VectorXd left = orthogonal_part(Eigen::VectorXd(white.col(0)), basis);
  const auto n = static_cast<Eigen::Index>(time_s.size());
  for (std::size_t k = 0; k < rows.size(); ++k) {
    Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(n, 3);  // as in Begins
    columns(rows[k], 0) = 1.0;
    for (Eigen::Index i = rows[k]; i < n; ++i) {
      const double since_s = time_s[static_cast<std::size_t>(i)] - time_s[static_cast<std::size_t>(rows[k])];
      columns(i, 2) = 1.0;
      if (covariance.correlated > 0.0) columns(i, 1) = std::exp(-since_s / covariance.time_s);
    }
    const Eigen::MatrixXd own = orthogonal_part(Eigen::MatrixXd(whitened(point.filter, columns)), basis);
    const auto fall = [&](Eigen::Index column) {
      const double square = own.col(column).squaredNorm();
      return square > 1e-9 ? std::pow(own.col(column).dot(left), 2) / square / variance : 0.0;
    };
    if (fall(2) > std::max(fall(0), fall(1)) + kStays) {
      result[k] = Begins::jump;
    } else if (fall(0) > std::max(fall(1), fall(2))) {
      result[k] = Begins::reading;
    } else if (fall(2) > fall(1)) {
      result[k] = Begins::likely_jump;
    }
  }
  return result;
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
  const Eigen::VectorXd r = whitened(point.filter, residual_of(variant, solution)) / std::sqrt(solution.variance);
  if (!has_heavy_tails(r)) return false;
  const auto factor_of = [&](Eigen::Index i) { return (r[i] * r[i] + kFreedom) / (kFreedom + 1.0); };
  std::vector<Eigen::Index> off;
  for (Eigen::Index i = 0; i < r.size(); ++i) {
    if (factor_of(i) >= kOutlier) off.push_back(i);
  }
  std::stable_sort(off.begin(), off.end(),
                   [&](Eigen::Index a, Eigen::Index b) { return std::abs(r[a]) > std::abs(r[b]); });
  const std::vector<Begins> begins = what_begins(problem, variant, point, off, solution.variance);
  // One or two jumps are for an effect to explain, if without them the tails are not heavy.
  Eigen::VectorXd but_jumps = r;
  for (std::size_t k = 0, jumps = 0; k < off.size() && jumps < kFewestLevels - 1; ++k) {
    if (begins[k] < Begins::likely_jump) continue;
    but_jumps[off[k]] = 0.0;
    ++jumps;
  }
  if (!has_heavy_tails(but_jumps)) return false;
  bool any = false;
  for (std::size_t k = 0; k < off.size(); ++k) {
    if (begins[k] == Begins::jump) continue;
    const auto row = static_cast<std::size_t>(off[k]);
    const double factor = factor_of(off[k]);
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
