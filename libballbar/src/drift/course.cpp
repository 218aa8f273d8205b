#include <Eigen/Core>
#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "ballbar/drift/thermal_test.hpp"
#include "ballbar/internal/numerics/order_statistic.hpp"
#include "drift/row_scatter.hpp"
#include "drift/smooth_curve.hpp"
#include "numerics/not_finite.hpp"

namespace ballbar {
namespace {

constexpr Eigen::Index kFewestReadings = 8, kBetweenSteps = 3;
constexpr std::size_t kMostSteps = 3, kMostReadings = 2000;
constexpr int kTimeConstants = 24;
constexpr double kStepCosts = 3.0;  // parameters
constexpr int kSweeps = 4;
constexpr double kNoShape = 2.0;  // times the scatter of the rows: a larger residual is no noise

struct CourseFit {
  double squares = std::numeric_limits<double>::infinity();
  double independent = 0.0;  // readings, as far as neighbouring residuals are not correlated
  double penalty = 0.0;      // of BIC
  double noise_um = 0.0, tau_s = 0.0;
  Eigen::VectorXd gains, sigmas;    // a, b or c, steps
  std::vector<Eigen::Index> steps;  // their first rows
};

// Where one more step lowers the sum of squares most; -1: nowhere.
Eigen::Index best_step(const Eigen::MatrixXd& basis, const Eigen::VectorXd& left,
                       const std::vector<Eigen::Index>& steps) {
  const Eigen::Index n = left.size();
  Eigen::RowVectorXd along = Eigen::RowVectorXd::Zero(basis.cols());
  double sum = 0.0, most = 0.0;
  Eigen::Index best = -1;
  for (Eigen::Index row = n - 1; row >= kBetweenSteps; --row) {  // 1 from `row` on
    along += basis.row(row);
    sum += left[row];
    const auto is_near = [&](Eigen::Index step) { return std::abs(step - row) < kBetweenSteps; };
    if (n - row < kBetweenSteps || std::any_of(steps.begin(), steps.end(), is_near)) continue;
    const double own = static_cast<double>(n - row) - along.squaredNorm();
    if (own > 1e-9 && sum * sum / own > most) most = sum * sum / own, best = row;
  }
  return best;
}

// Constant, shape and steps, by least squares. `shape`: empty for still.
Eigen::MatrixXd design_of(Eigen::Index n, const Eigen::VectorXd& shape, const std::vector<Eigen::Index>& steps) {
  const Eigen::Index of_shape = shape.size() > 0 ? 1 : 0;
  Eigen::MatrixXd x = Eigen::MatrixXd::Zero(n, 1 + of_shape + static_cast<Eigen::Index>(steps.size()));
  x.col(0).setOnes();
  if (of_shape > 0) x.col(1) = shape;
  for (std::size_t k = 0; k < steps.size(); ++k)
    x.col(1 + of_shape + static_cast<Eigen::Index>(k)).tail(n - steps[k]).setOnes();
  return x;
}

CourseFit fit_with(const Eigen::VectorXd& y, const Eigen::VectorXd& shape, const std::vector<Eigen::Index>& steps) {
  const Eigen::Index n = y.size();
  const Eigen::MatrixXd x = design_of(n, shape, steps);
  CourseFit fit;
  fit.gains = x.householderQr().solve(y);
  const Eigen::VectorXd left = y - x * fit.gains;
  fit.squares = std::max(left.squaredNorm(), 1e-18);
  const double r = std::clamp(left.head(n - 1).dot(left.tail(n - 1)) / fit.squares, 0.0, 0.9);
  fit.independent = static_cast<double>(n) * (1.0 - r) / (1.0 + r);
  fit.noise_um = std::sqrt(fit.squares / std::max(1.0, static_cast<double>(n - x.cols())));
  const Eigen::MatrixXd inverse = (x.transpose() * x).ldlt().solve(Eigen::MatrixXd::Identity(x.cols(), x.cols()));
  fit.sigmas = fit.noise_um * ((1.0 + r) / (1.0 - r) * inverse.diagonal()).cwiseMax(0.0).cwiseSqrt();
  fit.steps = steps;
  return fit;
}

Eigen::Index best_step(const Eigen::VectorXd& y, const Eigen::VectorXd& shape, const std::vector<Eigen::Index>& steps) {
  const Eigen::MatrixXd x = design_of(y.size(), shape, steps);
  const Eigen::HouseholderQR<Eigen::MatrixXd> parts(x);
  return best_step(parts.householderQ() * Eigen::MatrixXd::Identity(x.rows(), x.cols()), y - x * parts.solve(y), steps);
}

// With as many steps as BIC pays for. After each new step the others are moved to where they are best.
CourseFit fit_of(const Eigen::VectorXd& y, const Eigen::VectorXd& shape, double free_of_shape) {
  const double log_n = std::log(static_cast<double>(y.size()));
  std::vector<Eigen::Index> steps;
  CourseFit best = fit_with(y, shape, steps);
  while (steps.size() < kMostSteps) {
    const Eigen::Index row = best_step(y, shape, steps);
    if (row < 0) break;
    steps.push_back(row);
    bool is_moving = steps.size() > 1;
    for (int sweep = 0; sweep < kSweeps && is_moving; ++sweep) {
      is_moving = false;
      for (Eigen::Index& step : steps) {
        std::vector<Eigen::Index> others = steps;
        others.erase(others.begin() + (&step - steps.data()));
        const Eigen::Index moved = best_step(y, shape, others);
        is_moving = is_moving || (moved >= 0 && moved != step);
        if (moved >= 0) step = moved;
      }
    }
    CourseFit now = fit_with(y, shape, steps);
    const auto more = static_cast<double>(steps.size() - best.steps.size());
    if (now.independent * std::log(best.squares / now.squares) > kStepCosts * more * log_n) best = std::move(now);
  }
  best.penalty = (1.0 + free_of_shape + kStepCosts * static_cast<double>(best.steps.size())) * log_n;
  return best;
}

double white_bic(const CourseFit& fit, Eigen::Index n) {
  return static_cast<double>(n) * std::log(fit.squares) + fit.penalty;
}

}  // namespace

std::string_view name_of(CourseShape shape) {
  constexpr std::array<std::string_view, 4> kNames{"still", "trend", "decay", "none"};
  return kNames[static_cast<std::size_t>(shape)];
}

std::optional<Course> course_of(std::span<const double> time_s, std::span<const double> value_um) {
  std::vector<double> times, values;
  for (std::size_t row = 0; row < time_s.size(); ++row) {
    if (!std::isfinite(value_um[row])) continue;
    times.push_back(time_s[row] - time_s[0]);
    values.push_back(value_um[row]);
  }
  average_blocks(times, values, kMostReadings);
  const auto n = static_cast<Eigen::Index>(values.size());
  if (n < kFewestReadings) return std::nullopt;
  const Eigen::VectorXd t = Eigen::VectorXd::Map(times.data(), n);
  const Eigen::VectorXd y = Eigen::VectorXd::Map(values.data(), n);
  std::array<CourseFit, 3> fits{fit_of(y, {}, 0.0), fit_of(y, t / 3600.0, 1.0), CourseFit{}};
  const auto try_tau = [&](double tau_s) {
    CourseFit one = fit_of(y, (-t / tau_s).array().exp().matrix(), 2.0);
    one.tau_s = tau_s;
    if (white_bic(one, n) < white_bic(fits[2], n)) fits[2] = std::move(one);
  };
  const double least_s = 2.0 * median_step_s(times), most_s = 0.5 * (times.back() - times.front());
  const double factor = std::pow(most_s / least_s, 1.0 / kTimeConstants);
  for (int k = 0; k <= kTimeConstants; ++k) try_tau(least_s * std::pow(factor, k));
  const double near_s = fits[2].tau_s;
  for (int k = 1 - kTimeConstants; k < kTimeConstants; ++k)
    try_tau(near_s * std::pow(factor, static_cast<double>(k) / kTimeConstants));
  const auto closest =
      std::min_element(fits.begin(), fits.end(), [](const auto& a, const auto& b) { return a.squares < b.squares; });
  const auto bic = [&](const CourseFit& one) { return closest->independent * std::log(one.squares) + one.penalty; };
  const auto best =
      std::min_element(fits.begin(), fits.end(), [&](const auto& a, const auto& b) { return bic(a) < bic(b); });
  double sum = 0.0;
  for (const CourseFit& one : fits) sum += std::exp(0.5 * (bic(*best) - bic(one)));
  Course course;
  course.shape = static_cast<CourseShape>(best - fits.begin());
  course.probability = 1.0 / sum;
  course.trend_um_per_h = {fits[1].gains[1], fits[1].sigmas[1]};
  course.decay = {-fits[2].gains[1], fits[2].sigmas[1]};
  course.time_constant_s = fits[2].tau_s;
  course.noise_um = best->noise_um;
  const std::optional<double> scatter = row_scatter(times, values);
  if (scatter && best->noise_um > kNoShape * *scatter) {
    course.shape = CourseShape::none;
    course.probability = kUnknown;
    course.noise_um = *scatter;
    course.left_um = best->noise_um;
    return course;
  }
  const Eigen::Index first = best->gains.size() - static_cast<Eigen::Index>(best->steps.size());
  for (std::size_t k = 0; k < best->steps.size(); ++k) {
    const Eigen::Index of = first + static_cast<Eigen::Index>(k);
    course.steps.push_back({time_s[0] + t[best->steps[k]], {best->gains[of], best->sigmas[of]}});
  }
  std::sort(course.steps.begin(), course.steps.end(),
            [](const CourseStep& a, const CourseStep& b) { return a.time_s < b.time_s; });
  return course;
}

}  // namespace ballbar
