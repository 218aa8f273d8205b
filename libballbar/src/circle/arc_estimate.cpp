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
struct SizeOf {
  double times, prior;  // of the usual oval
};
constexpr std::array kOvals = {SizeOf{0.5, 0.3}, SizeOf{1.0, 0.45}, SizeOf{2.0, 0.2}, SizeOf{4.0, 0.05}};
// Of the third harmonic. More of it is seldom, and then the readings of a longer arc show it.
constexpr std::array kThirds = {SizeOf{0.0, 0.9}, SizeOf{0.25, 0.07}, SizeOf{0.7, 0.03}};
constexpr std::array kLogWhites = {-6.0, 0.0, 2.0, 4.0};  // white variance over what is new of the memory in a row
constexpr std::size_t kMemories = 6;
constexpr double kLongestMemory = 0.25;  // of the arc: what lasts longer has the form of the circle and its oval
constexpr Eigen::Index kFewRows = 16;    // of which no memory can be told
constexpr double kUnlikely = 9.0;        // ln of the likelihood below the best

constexpr int kArcColumns = ArcRows::kColumns, kArcUnknowns = kArcColumns - 1;
using Triangle = Eigen::Matrix<double, kArcColumns, kArcColumns>;
using ArcUnknowns = Eigen::Vector<double, kArcUnknowns>;
using ArcUnknownsCovariance = Eigen::Matrix<double, kArcUnknowns, kArcUnknowns>;

// Standard deviations of u, and their share beforehand.
struct Sizes {
  Eigen::Vector4d um;
  double prior = 0.0;
};

std::vector<Sizes> sizes_of(double oval_um) {
  std::vector<Sizes> sizes;
  for (const SizeOf& second : kOvals) {
    for (const SizeOf& third : kThirds) {
      sizes.push_back({oval_um * Eigen::Vector4d(second.times, second.times, third.times, third.times),
                       second.prior * third.prior});
    }
  }
  return sizes;
}

// With one noise and one size of u: what they leave likely.
struct Point {
  double log_likelihood = 0.0, weight = 0.0;  // weights sum to 1
  ArcUnknowns mean;
  ArcUnknownsCovariance covariance;
};

Triangle triangle_of(const Eigen::MatrixXd& columns) {
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(columns);
  Triangle triangle = Triangle::Zero();
  const Eigen::Index rows = std::min<Eigen::Index>(kArcColumns, columns.rows());
  triangle.topRows(rows) = qr.matrixQR().topRows(rows).triangularView<Eigen::Upper>();
  return triangle;
}

// The triangle of white [X Z y], with the prior of u as rows more:
//   |U b - q|^2 + d^2,  covariance (U' U)^-1,  -2 ln L = ln det V + n ln v + 2 ln s1 s2 s3 s4 + ln det U' U + d^2
Point point_of(const Triangle& white, double log_determinant, double rows, double variance,
               const Eigen::Vector4d& sizes_um) {
  constexpr double kNothing_um = 1e-6;
  Eigen::MatrixXd stacked = Eigen::MatrixXd::Zero(kArcColumns + 4, kArcColumns);
  stacked.topRows<kArcColumns>() = white / std::sqrt(variance);
  double log_sizes = 0.0;
  for (int k = 0; k < 4; ++k) {
    const double size = std::max(sizes_um[k], kNothing_um);
    stacked(kArcColumns + k, 3 + k) = 1.0 / size;
    log_sizes += std::log(size);
  }
  const Triangle triangle = triangle_of(stacked);
  const auto upper = triangle.topLeftCorner<kArcUnknowns, kArcUnknowns>().triangularView<Eigen::Upper>();
  const ArcUnknownsCovariance inverse = upper.solve(ArcUnknownsCovariance::Identity());
  Point point;
  point.mean = inverse * triangle.topRightCorner<kArcUnknowns, 1>();
  point.covariance = inverse * inverse.transpose();
  point.log_likelihood = -0.5 * (log_determinant + rows * std::log(variance) + 2.0 * log_sizes +
                                 2.0 * triangle.diagonal().head<kArcUnknowns>().array().abs().log().sum() +
                                 triangle(kArcUnknowns, kArcUnknowns) * triangle(kArcUnknowns, kArcUnknowns));
  return point;
}

// v: what X and Z leave; of few rows what X leaves, and u is in it.
double variance_of(const Triangle& white, Eigen::Index rows) {
  const double least = std::numeric_limits<double>::min();
  const Eigen::Index fitted = rows < kFewRows ? 3 : kArcUnknowns;
  return std::max(white.col(kArcUnknowns).tail(kArcColumns - fitted).squaredNorm() / static_cast<double>(rows - fitted),
                  least);
}

// Independent rows over rows, for the worst of b:  v (X'X)^-1 over (X' V^-1 X)^-1, of one variance of a row.
double effective_share(const Triangle& plain, const Triangle& white) {
  const auto variances = [](const Triangle& triangle) {
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
  const Triangle plain = triangle_of(rows.columns);
  const std::vector<Covariance> noises = noises_of(n);
  const std::vector<Sizes> sizes = sizes_of(oval_um);
  std::vector<Point> points;
  double best = -std::numeric_limits<double>::infinity();
  ArcEstimate estimate;
  for (const Covariance& noise : noises) {
    const Whitening whitening(noise, times);
    const Triangle white = triangle_of(whitened_rows(whitening, rows.columns));
    const double variance = variance_of(white, n);
    // White noise is as likely beforehand as all memories together.
    const double log_prior = noise.correlated > 0.0 ? -std::log(static_cast<double>(noises.size() - 1)) : 0.0;
    for (const auto& [sizes_um, prior] : sizes) {
      Point point = point_of(white, whitening.log_determinant(), static_cast<double>(n), variance, sizes_um);
      point.log_likelihood += log_prior + std::log(prior);
      if (point.log_likelihood > best) {
        best = point.log_likelihood;
        estimate.autocorrelation = noise.correlated > 0.0 ? std::exp(-1.0 / noise.time_s) : 0.0;
        estimate.effective_share = noise.correlated > 0.0 ? effective_share(plain, white) : 1.0;
      }
      points.push_back(point);
    }
  }
  std::erase_if(points, [&](const Point& point) { return point.log_likelihood < best - kUnlikely; });
  double sum = 0.0;
  for (Point& point : points) sum += point.weight = std::exp(point.log_likelihood - best);
  ArcUnknowns mean = ArcUnknowns::Zero();
  ArcUnknownsCovariance square = ArcUnknownsCovariance::Zero();
  for (Point& point : points) {
    point.weight /= sum;
    mean += point.weight * point.mean;
    square += point.weight * (point.covariance + point.mean * point.mean.transpose());
  }
  estimate.b = mean.head<3>();
  estimate.u = mean.tail<4>();
  estimate.covariance_um2 = (square - mean * mean.transpose()).topLeftCorner<3, 3>();
  return estimate;
}

}  // namespace ballbar
