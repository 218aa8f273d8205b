#include "ballbar/history/machine_geometry.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

#include "ballbar/history/trend.hpp"
#include "numerics/not_finite.hpp"
#include "numerics/tails.hpp"

namespace ballbar {
namespace {

constexpr std::array kPlanesInOrder{Plane::XY, Plane::YZ, Plane::ZX};
constexpr double kDisagree = 0.01;  // p

bool tells(const MachineTest& test) { return test.scales || test.squareness; }

// Whether the left one says less of today: stored values before sigmas, no date before any.
bool is_older(const MachineTest& left, const MachineTest& right) {
  if (left.stored != right.stored) return left.stored;
  return left.started_s < right.started_s;
}

std::vector<std::size_t> newest_set(std::span<const MachineTest> tests) {
  std::optional<std::int64_t> newest_s;
  for (const MachineTest& test : tests) {
    if (tells(test) && !test.stored) newest_s = std::max(newest_s, test.started_s);
  }
  std::vector<std::size_t> set;
  for (const Plane plane : kPlanesInOrder) {
    std::vector<std::size_t> of_plane;
    std::optional<std::size_t> newest;
    for (std::size_t i = 0; i < tests.size(); ++i) {
      const MachineTest& test = tests[i];
      if (test.plane != plane || !tells(test)) continue;
      if (!newest || is_older(tests[*newest], test)) newest = i;
      const bool of_the_day = newest_s && test.started_s && static_cast<double>(*newest_s - *test.started_s) <= kDay_s;
      if (of_the_day && !test.stored) of_plane.push_back(i);
    }
    if (of_plane.empty() && newest) of_plane.push_back(*newest);
    std::stable_sort(of_plane.begin(), of_plane.end(), [&](std::size_t left, std::size_t right) {
      return tests[left].started_s < tests[right].started_s;
    });
    set.insert(set.end(), of_plane.begin(), of_plane.end());
  }
  return set;
}

bool within_a_day_of_each_other(std::span<const MachineTest> tests, const std::vector<std::size_t>& set) {
  std::optional<std::int64_t> first_s, last_s;
  for (const std::size_t i : set) {
    if (!tests[i].started_s) return false;
    first_s = std::min(*tests[i].started_s, first_s.value_or(*tests[i].started_s));
    last_s = std::max(last_s, tests[i].started_s);
  }
  return !first_s || static_cast<double>(*last_s - *first_s) <= kDay_s;
}

bool has_sigma(double sigma) { return std::isfinite(sigma) && sigma > 0.0; }

// Of one plane: the weighted mean, or the plain one where none has a sigma.
std::optional<PlaneSquareness> squareness_in(std::span<const MachineTest> tests, const std::vector<std::size_t>& set,
                                             Plane plane) {
  PlaneSquareness found;
  found.plane = plane;
  double weights = 0.0, sum = 0.0;
  bool weighted = false;
  for (const std::size_t i : set) {
    if (tests[i].plane == plane && tests[i].squareness) weighted = weighted || has_sigma(tests[i].squareness->sigma);
  }
  for (const std::size_t i : set) {
    if (tests[i].plane != plane || !tests[i].squareness) continue;
    const MachineError& row = *tests[i].squareness;
    if (weighted && !has_sigma(row.sigma)) continue;
    const double weight = weighted ? 1.0 / (row.sigma * row.sigma) : 1.0;
    weights += weight;
    sum += weight * row.value;
    found.unit = row.unit;
    found.tests.push_back(i);
  }
  if (found.tests.empty()) return std::nullopt;
  found.value = sum / weights;
  found.sigma = weighted ? std::sqrt(1.0 / weights) : kUnknown;
  if (!weighted || found.tests.size() < 2) return found;
  double chi2 = 0.0;
  for (const std::size_t i : found.tests) {
    chi2 += std::pow((tests[i].squareness->value - found.value) / tests[i].squareness->sigma, 2);
  }
  const std::size_t degrees = found.tests.size() - 1;
  found.p_value = chi2_upper_tail(chi2, degrees);
  if (found.p_value < kDisagree) found.sigma *= std::sqrt(chi2 / static_cast<double>(degrees));
  return found;
}

bool has_covariance(const AxisScales& scales) {
  return scales.covariance.allFinite() && scales.covariance.determinant() > 0.0;
}

// Least squares for the axes that the tests reach; unweighted where no test has a covariance.
void solve_scales(std::span<const MachineTest> tests, MachineGeometry& geometry) {
  bool weighted = false;
  for (const std::size_t i : geometry.tests)
    weighted = weighted || (tests[i].scales && has_covariance(*tests[i].scales));
  std::vector<std::size_t> used;
  std::array<int, 3> column{-1, -1, -1};
  for (const std::size_t i : geometry.tests) {
    if (tests[i].scales && (!weighted || has_covariance(*tests[i].scales))) used.push_back(i);
  }
  if (used.empty()) return;
  for (const std::size_t i : used) {
    for (const int axis : axes_of(tests[i].plane)) column[static_cast<std::size_t>(axis)] = 0;
  }
  int axes = 0;
  for (int& place : column) {
    if (place == 0) place = axes++;
  }
  const auto rows = static_cast<Eigen::Index>(2 * used.size());
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(rows, axes);
  Eigen::VectorXd y(rows);
  std::vector<Eigen::Matrix2d> covariances;
  covariances.reserve(used.size());
  for (std::size_t k = 0; k < used.size(); ++k) {
    const AxisScales& scales = *tests[used[k]].scales;
    const auto pair = axes_of(tests[used[k]].plane);
    const auto row = static_cast<Eigen::Index>(2 * k);
    for (int side = 0; side < 2; ++side) {
      a(row + side, column[static_cast<std::size_t>(pair[static_cast<std::size_t>(side)])]) = 1.0;
    }
    y.segment<2>(row) << scales.a_ppm, scales.b_ppm;
    covariances.push_back(weighted ? scales.covariance : Eigen::Matrix2d::Identity());
  }
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(axes, axes);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(axes);
  for (std::size_t k = 0; k < used.size(); ++k) {
    const auto row = static_cast<Eigen::Index>(2 * k);
    const Eigen::Matrix2d weight = covariances[k].inverse();
    normal += a.middleRows<2>(row).transpose() * weight * a.middleRows<2>(row);
    right += a.middleRows<2>(row).transpose() * (weight * y.segment<2>(row));
  }
  const Eigen::MatrixXd covariance = normal.inverse();
  const Eigen::VectorXd scale = covariance * right;
  const Eigen::VectorXd left = y - a * scale;
  for (std::size_t k = 0; k < used.size(); ++k) {
    const auto row = static_cast<Eigen::Index>(2 * k);
    const Eigen::Vector2d part = left.segment<2>(row);
    if (weighted) geometry.chi2 += part.dot(covariances[k].inverse() * part);
    const Eigen::Matrix2d of_residual =
        covariances[k] - a.middleRows<2>(row) * covariance * a.middleRows<2>(row).transpose();
    const auto pair = axes_of(tests[used[k]].plane);
    for (int side = 0; side < 2; ++side) {
      const double variance = covariances[k](side, side);
      constexpr double kRounding = 1e-9;  // an axis that one test alone tells leaves no residual
      const bool compared = weighted && of_residual(side, side) > kRounding * variance;
      geometry.pulls.push_back({used[k], pair[static_cast<std::size_t>(side)], y[row + side],
                                weighted ? std::sqrt(variance) : kUnknown,
                                compared ? part[side] / std::sqrt(of_residual(side, side)) : kUnknown});
    }
  }
  if (weighted) geometry.degrees = 2 * used.size() - static_cast<std::size_t>(axes);
  if (geometry.degrees > 0) {
    geometry.p_value = chi2_upper_tail(geometry.chi2, geometry.degrees);
    if (geometry.p_value < kDisagree) {
      geometry.widened = std::sqrt(geometry.chi2 / static_cast<double>(geometry.degrees));
    }
  }
  for (int axis = 0; axis < 3; ++axis) {
    const int place = column[static_cast<std::size_t>(axis)];
    if (place < 0) continue;
    std::vector<Plane> planes;
    for (const std::size_t i : used) {
      const auto pair = axes_of(tests[i].plane);
      if (pair[0] != axis && pair[1] != axis) continue;
      if (std::find(planes.begin(), planes.end(), tests[i].plane) == planes.end()) planes.push_back(tests[i].plane);
    }
    const double sigma = weighted ? geometry.widened * std::sqrt(covariance(place, place)) : kUnknown;
    geometry.scales.push_back({axis, scale[place], sigma, planes.size()});
  }
}

}  // namespace

MachineGeometry machine_geometry(std::span<const MachineTest> tests) {
  MachineGeometry geometry;
  geometry.tests = newest_set(tests);
  geometry.within_a_day = within_a_day_of_each_other(tests, geometry.tests);
  for (const Plane plane : kPlanesInOrder) {
    if (auto found = squareness_in(tests, geometry.tests, plane)) geometry.squareness.push_back(std::move(*found));
  }
  solve_scales(tests, geometry);
  return geometry;
}

}  // namespace ballbar
