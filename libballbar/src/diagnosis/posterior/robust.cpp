#include "diagnosis/posterior/robust.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "ballbar/internal/numerics/order_statistic.hpp"
#include "diagnosis/posterior/hyperparameters.hpp"
#include "diagnosis/posterior/linearisation.hpp"
#include "noise/whitening.hpp"

namespace ballbar {
namespace {

constexpr double kUsualShare = 0.85;  // of the steps that are no jumps

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

// A row that tells nothing is no reading.
std::vector<std::size_t> rows_with_readings(const Problem& problem) {
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < problem.stated_variance.size(); ++i) {
    if (!(problem.stated_variance[i] > 0.0)) rows.push_back(i);
  }
  return rows;
}

}  // namespace

bool weigh_down_outliers(Problem& problem, const LinearModel& linear, const NoiseFilter& filter) {
  const LinearSolution solution = linear_solution(filter.whitening, linear, problem.known);
  const Eigen::VectorXd r = whitened(filter.whitening, residual_of(linear, solution)) / std::sqrt(solution.variance);
  if (!has_heavy_tails(r(rows_with_readings(problem)))) return false;
  bool any = false;
  for (std::size_t row = 0; row < problem.time_s.size(); ++row) {
    const double factor =
        (std::pow(r[static_cast<Eigen::Index>(row)], 2) + problem.tuning.freedom) / (problem.tuning.freedom + 1.0);
    if (factor < problem.tuning.outlier) continue;
    problem.relative_variance[row] *= factor;
    any = true;
  }
  return any;
}

std::vector<LevelJump> level_jumps(const Problem& problem, const Eigen::VectorXd& residual_um) {
  const std::vector<std::size_t> known = rows_with_readings(problem);
  std::vector<double> r;
  r.reserve(known.size());
  for (const std::size_t i : known) r.push_back(residual_um[static_cast<Eigen::Index>(i)]);
  if (known.size() < problem.tuning.fewest_for_memory || !std::is_sorted(problem.time_s.begin(), problem.time_s.end()))
    return {};
  // The mean of a few rows less that of the rows before.
  std::vector<double> steps(r.size(), 0.0), sizes;
  const auto mean_from = [&](std::size_t first) {
    return std::accumulate(r.begin() + static_cast<std::ptrdiff_t>(first),
                           r.begin() + static_cast<std::ptrdiff_t>(first + problem.tuning.rows_of_level), 0.0) /
           static_cast<double>(problem.tuning.rows_of_level);
  };
  for (std::size_t k = problem.tuning.rows_of_level; k + problem.tuning.rows_of_level <= r.size(); ++k) {
    steps[k] = mean_from(k) - mean_from(k - problem.tuning.rows_of_level);
  }
  // What a slow drift does from row to row is no jump.
  steps = less_running_median(steps, problem.tuning.rows_of_trend);
  for (std::size_t k = problem.tuning.rows_of_level; k + problem.tuning.rows_of_level <= r.size(); ++k)
    sizes.push_back(std::abs(steps[k]));
  std::vector<double> sorted = sizes;
  std::sort(sorted.begin(), sorted.end());
  const auto usual = static_cast<std::size_t>(kUsualShare * static_cast<double>(sorted.size()));
  const double mean = std::accumulate(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(usual), 0.0) /
                      static_cast<double>(std::max<std::size_t>(1, usual));
  // Of a normal distribution: the median of the sizes is 0.67 sigma, the mean of the smaller 85 % 0.55 sigma.
  const double sigma = std::max({sorted[sorted.size() / 2] / 0.67, mean / 0.55, resolution_of_readings(problem.y)});
  std::vector<LevelJump> jumps;
  for (std::size_t k = problem.tuning.rows_of_level; k + problem.tuning.rows_of_level <= r.size(); ++k) {
    const double size = std::abs(steps[k]);
    if (!(size > problem.tuning.jump_off * sigma) || std::abs(r[k] - r[k - 1]) < problem.tuning.sharp * size) continue;
    bool is_largest = true;
    for (std::size_t j = k - problem.tuning.rows_of_level; j <= k + problem.tuning.rows_of_level && j < steps.size();
         ++j)
      is_largest = is_largest && std::abs(steps[j]) <= size;
    if (is_largest) jumps.push_back({known[k], size});
  }
  if (jumps.size() < problem.tuning.fewest_levels) return {};
  std::stable_sort(jumps.begin(), jumps.end(),
                   [](const LevelJump& a, const LevelJump& b) { return a.size_um > b.size_um; });
  if (jumps.size() > problem.tuning.most_levels) jumps.resize(problem.tuning.most_levels);
  return jumps;
}

void note_outliers(Problem& problem) {
  if (!problem.covariances.empty() || problem.model.level != Level::series) return;
  const bool has_forms = problem.library.families.size() > problem.effects;  // else the jumps may be those of an effect
  const auto rich = [&] {
    return with_any_forms(problem, linearisation_at(problem, std::nullopt, fitted_parameters(problem)).linear);
  };
  LinearModel linear = rich();
  NoiseFilter filter = noise_filter_at(problem, likeliest_covariance(problem, linear, Discrepancy::none));
  if (has_forms)
    problem.level_jumps =
        level_jumps(problem, residual_of(linear, linear_solution(filter.whitening, linear, problem.known)));
  if (!problem.level_jumps.empty()) {
    linear = rich();
    filter = noise_filter_at(problem, likeliest_covariance(problem, linear, Discrepancy::none));
  }
  weigh_down_outliers(problem, linear, filter);
}

}  // namespace ballbar
