#include <ceres/tiny_solver.h>

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "ballbar/drift/thermal_test.hpp"
#include "drift/row_scatter.hpp"
#include "drift/smooth_curve.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kRowsToSettle = 6;
constexpr int kTaus = 20;         // of the grid from which the fit starts
constexpr double kLongest = 3.0;  // time constant, times the stretch
constexpr double kLeastBand_um = 2.0, kBandOfRange = 0.1;
constexpr std::size_t kRowsOfFit = 2000;  // means of more
constexpr int kLastSteps = 4;
constexpr double kCollinearCurves = 1e-8;
constexpr double kLeastOfTheWay = 0.75;
constexpr double kLeastOfTheTime = 0.5;
constexpr double kMostShare = 0.5;  // sigma of the time, of it

struct SettlingRows {
  Eigen::ArrayXd time_s;
  Eigen::ArrayXd drift_um;
};

SettlingRows settling_data(std::span<const double> time_s, std::span<const double> drift_um) {
  std::vector<double> times, values;
  for (std::size_t i = 0; i < time_s.size(); ++i) {
    if (!std::isfinite(drift_um[i])) continue;
    times.push_back(time_s[i] - time_s.front());
    values.push_back(drift_um[i]);
  }
  return {Eigen::ArrayXd::Map(times.data(), static_cast<Eigen::Index>(times.size())),
          Eigen::ArrayXd::Map(values.data(), static_cast<Eigen::Index>(values.size()))};
}

// c, then amplitude and ln of the time constant of each curve.
using Settling = Eigen::VectorXd;

Eigen::Index curves_of(const Settling& of) { return of.size() / 2; }

double tau_s(const Settling& of, Eigen::Index k) { return std::exp(of[2 + 2 * k]); }

// d(t) - c
double distance(const Settling& of, double time_s) {
  double sum = 0.0;
  for (Eigen::Index k = 0; k < curves_of(of); ++k) sum += of[1 + 2 * k] * std::exp(-time_s / tau_s(of, k));
  return sum;
}

// Residuals and Jacobian, for ceres::TinySolver.
struct SettlingCost {
  using Scalar = double;
  enum { NUM_PARAMETERS = Eigen::Dynamic, NUM_RESIDUALS = Eigen::Dynamic };
  const SettlingRows& rows;
  Eigen::Index size;  // of Settling

  int NumParameters() const { return static_cast<int>(size); }
  int NumResiduals() const { return static_cast<int>(rows.time_s.size()); }
  bool operator()(const double* values, double* residuals, double* jacobian) const {
    const Settling of = Settling::Map(values, size);
    Eigen::Map<Eigen::ArrayXd> left(residuals, rows.time_s.size());
    left = of[0] - rows.drift_um;
    Eigen::MatrixXd slopes(rows.time_s.size(), size);
    slopes.col(0).setOnes();
    for (Eigen::Index k = 0; k < curves_of(of); ++k) {
      const Eigen::ArrayXd age = rows.time_s / tau_s(of, k), curve = (-age).exp();
      left += of[1 + 2 * k] * curve;
      slopes.col(1 + 2 * k) = curve.matrix();
      slopes.col(2 + 2 * k) = (of[1 + 2 * k] * curve * age).matrix();
    }
    if (jacobian != nullptr) Eigen::MatrixXd::Map(jacobian, slopes.rows(), slopes.cols()) = slopes;
    return left.isFinite().all();
  }
};

struct SettlingFit {
  double log_likelihood = 0.0;  // less the penalty of BIC
  double time_s = 0.0, time_variance = 0.0, final_um = 0.0, final_variance = 0.0, share_at_end = 0.0;
  double left_um = 0.0;  // standard deviation of the residual
};

// The last time at which the curve is the band away from c; 0: it never is.
double last_crossing_s(const Settling& of, double band_um) {
  double largest = 0.0, longest_s = 0.0;
  for (Eigen::Index k = 0; k < curves_of(of); ++k) {
    largest += std::abs(of[1 + 2 * k]);
    longest_s = std::max(longest_s, tau_s(of, k));
  }
  if (largest <= band_um) return 0.0;
  const double beyond_s = longest_s * std::log(largest / band_um);  // there the sum of the sizes is the band
  constexpr int kSteps = 200;
  for (int i = kSteps; i > 0; --i) {
    double low_s = beyond_s * (i - 1) / kSteps, high_s = beyond_s * i / kSteps;
    if (std::abs(distance(of, low_s)) < band_um) continue;
    for (int step = 0; step < 40; ++step) {
      const double middle_s = 0.5 * (low_s + high_s);
      (std::abs(distance(of, middle_s)) < band_um ? high_s : low_s) = middle_s;
    }
    return high_s;
  }
  return 0.0;
}

// Least squares of c and the amplitudes for given time constants, and the sum of squares that they leave.
std::pair<double, Settling> with_taus(const SettlingRows& rows, const std::vector<double>& taus) {
  const auto curves = static_cast<Eigen::Index>(taus.size());
  Eigen::MatrixXd x(rows.time_s.size(), 1 + curves);
  x.col(0).setOnes();
  for (Eigen::Index k = 0; k < curves; ++k)
    x.col(1 + k) = (-rows.time_s / taus[static_cast<std::size_t>(k)]).exp().matrix();
  const Eigen::VectorXd drift_um = rows.drift_um.matrix(), products = x.transpose() * drift_um;
  const Eigen::MatrixXd equations = x.transpose() * x;
  const Eigen::VectorXd gains = equations.ldlt().solve(products);
  Settling start(1 + 2 * curves);
  start[0] = gains[0];
  for (Eigen::Index k = 0; k < curves; ++k) {
    start[1 + 2 * k] = gains[1 + k];
    start[2 + 2 * k] = std::log(taus[static_cast<std::size_t>(k)]);
  }
  return {(drift_um - x * gains).squaredNorm(), start};
}

std::optional<SettlingFit> settling_fit(const SettlingRows& rows, int curves, const std::vector<double>& grid_s,
                                        double band_um) {
  const Eigen::Index n = rows.time_s.size(), unknowns = 1 + 2 * curves;
  if (n < unknowns + 2) return std::nullopt;
  std::pair<double, Settling> best{std::numeric_limits<double>::infinity(), Settling::Zero(unknowns)};
  const auto try_taus = [&](const std::vector<double>& taus) {
    const auto one = with_taus(rows, taus);
    if (one.first < best.first) best = one;
  };
  for (std::size_t k = 0; k < grid_s.size(); ++k) {
    if (curves == 1) try_taus({grid_s[k]});
    for (std::size_t m = k + 2; curves == 2 && m < grid_s.size(); ++m) try_taus({grid_s[k], grid_s[m]});
  }
  const SettlingCost cost{rows, unknowns};
  ceres::TinySolver<SettlingCost> solver;
  solver.options.function_tolerance = 1e-14;
  solver.options.max_num_iterations = 200;
  Settling of = best.second;
  solver.Solve(cost, &of);
  Eigen::VectorXd left(n);
  Eigen::MatrixXd slopes(n, unknowns);
  // The sum of squares tells the values to half of the digits; steps of Gauss and Newton tell the rest, so that every
  // build has one answer.
  for (int step = 0; step < kLastSteps; ++step) {
    if (!cost(of.data(), left.data(), slopes.data())) return std::nullopt;
    const Settling by = -slopes.colPivHouseholderQr().solve(left);
    if (!by.allFinite() || by.norm() > 1e-3 * of.norm()) break;
    of += by;
  }
  if (!cost(of.data(), left.data(), slopes.data())) return std::nullopt;
  const double squares = std::max(left.squaredNorm(), 1e-18);
  const double r = std::clamp(left.head(n - 1).dot(left.tail(n - 1)) / squares, 0.0, 0.9);
  // The variance of Student's t: the noise is known from few rows.
  const auto freedom = static_cast<double>(n - unknowns);
  const double student = freedom > 2.0 ? freedom / (freedom - 2.0) : 3.0;
  const double variance = student * squares / freedom * (1.0 + r) / (1.0 - r);
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> parts;
  parts.setThreshold(kCollinearCurves);
  parts.compute(slopes);
  if (parts.rank() < unknowns) return std::nullopt;
  const Eigen::MatrixXd inverse = parts.colsPermutation() * parts.matrixR()
                                                                .topLeftCorner(unknowns, unknowns)
                                                                .triangularView<Eigen::Upper>()
                                                                .solve(Eigen::MatrixXd::Identity(unknowns, unknowns));
  const Eigen::MatrixXd covariance = variance * inverse * inverse.transpose();

  SettlingFit result;
  const auto independent = static_cast<double>(n) * (1.0 - r) / (1.0 + r);
  result.log_likelihood = -0.5 * independent * std::log(squares / static_cast<double>(n)) -
                          0.5 * static_cast<double>(unknowns) * std::log(static_cast<double>(n));
  result.left_um = std::sqrt(squares / freedom);
  result.time_s = last_crossing_s(of, band_um);
  Settling gradient = Settling::Zero(unknowns), of_final = gradient;
  double slope = 0.0;
  for (Eigen::Index k = 0; k < curves; ++k) {
    const double age = result.time_s / tau_s(of, k), curve = std::exp(-age);
    slope -= of[1 + 2 * k] * curve / tau_s(of, k);
    gradient[1 + 2 * k] = curve;
    gradient[2 + 2 * k] = of[1 + 2 * k] * curve * age;
    of_final[1 + 2 * k] = -1.0;
    result.final_um -= of[1 + 2 * k];
  }
  if (result.time_s > 0.0) result.time_variance = gradient.dot(covariance * gradient) / (slope * slope);
  result.final_variance = of_final.dot(covariance * of_final);
  result.share_at_end = result.final_um == 0.0 ? 1.0 : 1.0 + distance(of, rows.time_s[n - 1]) / result.final_um;
  return result;
}

// SettlingRows until the drift turns back for good.
std::size_t settling_rows(const std::vector<double>& drift_um, double band_um) {
  const auto size = [&](std::size_t i) { return std::abs(drift_um[i] - drift_um.front()); };
  std::size_t largest = 0;
  for (std::size_t i = 1; i < drift_um.size(); ++i) {
    if (size(i) > size(largest)) largest = i;
  }
  std::size_t end = drift_um.size();
  while (end > largest + 1 && std::abs(drift_um[end - 1] - drift_um[largest]) > band_um) --end;
  return end;
}

}  // namespace

std::optional<StableTime> stable_time(std::span<const double> time_s, std::span<const double> drift_um,
                                      double band_um) {
  const SettlingRows rows = settling_data(time_s, drift_um);
  const Eigen::Index n = rows.time_s.size();
  if (static_cast<std::size_t>(n) < kRowsToSettle) return std::nullopt;
  const double length_s = rows.time_s[n - 1], step_s = length_s / static_cast<double>(n - 1);
  std::vector<double> grid_s;
  grid_s.reserve(kTaus);
  for (int k = 0; k < kTaus; ++k)
    grid_s.push_back(0.5 * step_s * std::pow(2.0 * kLongest * length_s / step_s, static_cast<double>(k) / (kTaus - 1)));
  std::vector<SettlingFit> fits;
  for (const auto& one : {settling_fit(rows, 1, grid_s, band_um), settling_fit(rows, 2, grid_s, band_um)}) {
    // Two curves that the rows do not tell apart say nothing of the time.
    const double most_s = one ? std::max(kMostShare * one->time_s, step_s) : 0.0;
    if (one && one->time_variance <= most_s * most_s) fits.push_back(*one);
  }
  // A curve that leaves more than the scatter of the rows, and much of the band, is not the course of the drift.
  const std::optional<double> scatter = row_scatter(time_s, drift_um);
  if (scatter && static_cast<std::size_t>(n) >= kRowsForScatter * 2)
    std::erase_if(fits, [&](const SettlingFit& fit) { return fit.left_um > std::max(3.0 * *scatter, 0.25 * band_um); });
  if (fits.empty()) return std::nullopt;
  const double most = std::max(fits.front().log_likelihood, fits.back().log_likelihood);
  StableTime stable;
  stable.band_um = band_um;
  double sum = 0.0, time_square = 0.0, final_square = 0.0;
  for (const SettlingFit& one : fits) {
    const double weight = std::exp(one.log_likelihood - most);
    sum += weight;
    stable.time_s += weight * one.time_s;
    stable.final_um += weight * one.final_um;
    stable.share_at_end += weight * one.share_at_end;
    time_square += weight * (one.time_s * one.time_s + one.time_variance);
    final_square += weight * (one.final_um * one.final_um + one.final_variance);
  }
  for (double* mean : {&stable.time_s, &stable.final_um, &stable.share_at_end}) *mean /= sum;
  stable.sigma_s = std::sqrt(std::max(0.0, time_square / sum - stable.time_s * stable.time_s));
  stable.final_sigma_um = std::sqrt(std::max(0.0, final_square / sum - stable.final_um * stable.final_um));
  stable.reached = stable.time_s < length_s;
  // Of less than three quarters of the way a curve that settles, a trend and half a cycle look alike.
  if (!stable.reached && stable.share_at_end < kLeastOfTheWay) return std::nullopt;
  const bool is_determined =
      stable.sigma_s <= std::max(kMostShare * stable.time_s, step_s) && std::isfinite(stable.sigma_s);
  return is_determined ? std::optional(stable) : std::nullopt;
}

std::vector<AxisSettling> settling_of(const MeasuredDrift& drift, std::size_t begin, std::size_t end,
                                      std::optional<double> band_um) {
  std::vector<AxisSettling> all;
  all.reserve(drift.axes.size());
  for (const DriftAxis& axis : drift.axes) {
    if (axis.unit != "um") continue;
    std::vector<double> times, values;
    for (std::size_t row = begin; row < end; ++row) {
      if (!std::isfinite(axis.value[row])) continue;
      times.push_back(drift.time_s[row]);
      values.push_back(axis.value[row]);
    }
    AxisSettling one{axis.name, kLeastBand_um, false, std::nullopt};
    if (!values.empty()) {
      const auto [least, most] = std::minmax_element(values.begin(), values.end());
      const double range_um = *most - *least;
      one.band_um = band_um.value_or(std::max(kLeastBand_um, kBandOfRange * range_um));
      one.is_small = range_um <= one.band_um;
    }
    if (!one.is_small && !values.empty()) {
      average_blocks(times, values, kRowsOfFit);
      const std::size_t rows = settling_rows(values, one.band_um);
      // What turns back for more than half of the time has not settled.
      const double length_s = times.back() - times.front();
      if (times[rows - 1] - times.front() >= kLeastOfTheTime * length_s)
        one.stable = stable_time(std::span(times).first(rows), std::span(values).first(rows), one.band_um);
    }
    all.push_back(std::move(one));
  }
  return all;
}

}  // namespace ballbar
