#include "circle/arc_estimate.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "ballbar/units.hpp"
#include "noise/linear_filter.hpp"
#include "noise/whitening.hpp"

namespace ballbar {
namespace {

constexpr double kOvalOfRadius = 20e-6, kLeastOval_um = 0.5;
struct OvalSize {
  double times, prior;
};
constexpr std::array kOvals = {OvalSize{0.5, 0.25}, OvalSize{1.0, 0.4}, OvalSize{2.0, 0.25}, OvalSize{4.0, 0.1}};
constexpr std::array kLogWhites = {-6.0, 0.0, 2.0, 4.0};  // white variance over what is new of the memory in a row
constexpr std::size_t kMemories = 6;
constexpr double kLongestMemory = 0.25;  // of the arc: what lasts longer has the form of the circle and its oval
constexpr Eigen::Index kFewRows = 12;    // of which no memory can be told
constexpr double kUnlikely = 20.0;       // ln of the likelihood below the best

using Matrix5d = Eigen::Matrix<double, 5, 5>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

// With what is likely of one noise and one size of the oval.
struct Point {
  double log_likelihood = 0.0;
  Eigen::Matrix<double, 5, 1> mean;
  Matrix5d covariance;
};

Matrix6d triangle_of(const Eigen::MatrixXd& columns) {
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(columns);
  Matrix6d triangle = Matrix6d::Zero();
  const Eigen::Index rows = std::min<Eigen::Index>(6, columns.rows());
  triangle.topRows(rows) = qr.matrixQR().topRows(rows).triangularView<Eigen::Upper>();
  return triangle;
}

// The triangle of white [X Z y], with the prior of the oval as two rows more:
//   |U b - q|^2 + d^2,  covariance (U' U)^-1,  -2 ln L = ln det V + n ln v + 4 ln s + ln det U' U + d^2
Point point_of(const Matrix6d& white, double log_determinant, double rows, double variance, double oval_um) {
  Eigen::MatrixXd stacked = Eigen::MatrixXd::Zero(8, 6);
  stacked.topRows<6>() = white / std::sqrt(variance);
  stacked(6, 3) = stacked(7, 4) = 1.0 / oval_um;
  const Matrix6d triangle = triangle_of(stacked);
  const auto upper = triangle.topLeftCorner<5, 5>().triangularView<Eigen::Upper>();
  const Matrix5d inverse = upper.solve(Matrix5d::Identity());
  Point point;
  point.mean = inverse * triangle.topRightCorner<5, 1>();
  point.covariance = inverse * inverse.transpose();
  point.log_likelihood = -0.5 * (log_determinant + rows * std::log(variance) + 4.0 * std::log(oval_um) +
                                 2.0 * triangle.diagonal().head<5>().array().abs().log().sum() +
                                 triangle(5, 5) * triangle(5, 5));
  return point;
}

// v: what X and Z leave; of few rows what X leaves, and the oval is in it.
double variance_of(const Matrix6d& white, Eigen::Index rows) {
  const double least = std::numeric_limits<double>::min();
  if (rows < kFewRows) return std::max(white.col(5).tail<3>().squaredNorm() / static_cast<double>(rows - 3), least);
  return std::max(white(5, 5) * white(5, 5) / static_cast<double>(rows - 5), least);
}

// Independent rows over rows, for the worst of b:  v (X'X)^-1 over (X' V^-1 X)^-1, of one variance of a row.
double effective_share(const Matrix6d& plain, const Matrix6d& white) {
  const auto variances = [](const Matrix6d& triangle) {
    const Eigen::Matrix3d inverse =
        triangle.topLeftCorner<3, 3>().triangularView<Eigen::Upper>().solve(Eigen::Matrix3d::Identity());
    return Eigen::Array3d(inverse.rowwise().squaredNorm().array());
  };
  return std::min(1.0, (variances(plain) / variances(white)).minCoeff());
}

std::vector<Covariance> noises_of(Eigen::Index rows) {
  std::vector<Covariance> noises{{}};
  if (rows < kFewRows) return noises;
  const double longest = std::max(2.0, kLongestMemory * static_cast<double>(rows));
  for (std::size_t k = 0; k < kMemories; ++k) {
    const double memory = std::pow(longest, static_cast<double>(k) / static_cast<double>(kMemories - 1));
    for (const double log_white : kLogWhites) noises.push_back(with_memory(1.0, log_white, 1.0, memory));
  }
  return noises;
}

}  // namespace

double usual_oval_um(double radius_mm) { return std::hypot(kLeastOval_um, kOvalOfRadius * um_from_mm(radius_mm)); }

ArcEstimate arc_estimate(const ArcRows& rows, double oval_um) {
  const Eigen::Index n = rows.columns.rows();
  std::vector<double> times(static_cast<std::size_t>(n));
  for (std::size_t i = 0; i < times.size(); ++i) times[i] = static_cast<double>(i);
  const Matrix6d plain = triangle_of(rows.columns);
  const std::vector<Covariance> noises = noises_of(n);
  std::vector<Point> points;
  double best = -std::numeric_limits<double>::infinity();
  ArcEstimate estimate;
  for (const Covariance& noise : noises) {
    const Whitening whitening(noise, times);
    const Matrix6d white = triangle_of(whitened_rows(whitening, rows.columns));
    const double variance = variance_of(white, n);
    // White noise is as likely beforehand as all memories together.
    const double log_prior = noise.correlated > 0.0 ? -std::log(static_cast<double>(noises.size() - 1)) : 0.0;
    for (const OvalSize& size : kOvals) {
      Point point =
          point_of(white, whitening.log_determinant(), static_cast<double>(n), variance, size.times * oval_um);
      point.log_likelihood += log_prior + std::log(size.prior);
      if (point.log_likelihood > best) {
        best = point.log_likelihood;
        estimate.autocorrelation = noise.correlated > 0.0 ? std::exp(-1.0 / noise.time_s) : 0.0;
        estimate.effective_share = noise.correlated > 0.0 ? effective_share(plain, white) : 1.0;
      }
      points.push_back(point);
    }
  }
  double sum = 0.0;
  Eigen::Matrix<double, 5, 1> mean = Eigen::Matrix<double, 5, 1>::Zero();
  Matrix5d square = Matrix5d::Zero();
  for (const Point& point : points) {
    if (!(point.log_likelihood > best - kUnlikely)) continue;
    const double weight = std::exp(point.log_likelihood - best);
    sum += weight;
    mean += weight * point.mean;
    square += weight * (point.covariance + point.mean * point.mean.transpose());
  }
  mean /= sum;
  estimate.b = mean.head<3>();
  estimate.oval_um = mean.tail<2>();
  estimate.covariance_um2 = (square / sum - mean * mean.transpose()).topLeftCorner<3, 3>();
  return estimate;
}

}  // namespace ballbar
