#include "ballbar/drift/course.hpp"

#include <Eigen/Core>
#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "ballbar/numerics/order_statistic.hpp"
#include "drift/smooth_curve.hpp"

namespace ballbar {
namespace {

constexpr Eigen::Index kFewestReadings = 8, kBetweenSteps = 3;
constexpr std::size_t kMostSteps = 3, kMostReadings = 2000;
constexpr int kTimeConstants = 24;
constexpr double kStepCosts = 3.0;  // parameters

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

// With as many steps as BIC pays for. `shape`: the column beside the constant; none: still.
CourseFit fit_of(const Eigen::VectorXd& y, const Eigen::VectorXd& shape, double free_of_shape) {
  const Eigen::Index n = y.size();
  const double log_n = std::log(static_cast<double>(n));
  CourseFit best;
  Eigen::MatrixXd x(n, shape.size() > 0 ? 2 : 1);
  x.col(0).setOnes();
  if (shape.size() > 0) x.col(1) = shape;
  std::vector<Eigen::Index> steps;
  while (true) {
    const Eigen::HouseholderQR<Eigen::MatrixXd> parts(x);
    const Eigen::VectorXd gains = parts.solve(y), left = y - x * gains;
    const double squares = std::max(left.squaredNorm(), 1e-18);
    const double r = std::clamp(left.head(n - 1).dot(left.tail(n - 1)) / squares, 0.0, 0.9);
    const double independent = static_cast<double>(n) * (1.0 - r) / (1.0 + r);
    if (!steps.empty() && independent * std::log(best.squares / squares) <= kStepCosts * log_n) return best;
    const double freedom = std::max(1.0, static_cast<double>(n - x.cols()));
    const Eigen::MatrixXd inverse = (x.transpose() * x).ldlt().solve(Eigen::MatrixXd::Identity(x.cols(), x.cols()));
    best.squares = squares;
    best.independent = independent;
    best.penalty = (1.0 + free_of_shape + kStepCosts * static_cast<double>(steps.size())) * log_n;
    best.noise_um = std::sqrt(squares / freedom);
    best.gains = gains;
    best.sigmas = best.noise_um * ((1.0 + r) / (1.0 - r) * inverse.diagonal()).cwiseMax(0.0).cwiseSqrt();
    best.steps = steps;
    if (steps.size() == kMostSteps) return best;
    const Eigen::MatrixXd basis = parts.householderQ() * Eigen::MatrixXd::Identity(n, x.cols());
    const Eigen::Index row = best_step(basis, left, steps);
    if (row < 0) return best;
    steps.push_back(row);
    x.conservativeResize(Eigen::NoChange, x.cols() + 1);
    x.col(x.cols() - 1).setZero();
    x.col(x.cols() - 1).tail(n - row).setOnes();
  }
}

double white_bic(const CourseFit& fit, Eigen::Index n) {
  return static_cast<double>(n) * std::log(fit.squares) + fit.penalty;
}

}  // namespace

std::string_view name_of(CourseShape shape) {
  constexpr std::array<std::string_view, 3> kNames{"still", "trend", "decay"};
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
