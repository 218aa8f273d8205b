#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "ballbar/history/history.hpp"
#include "numerics/not_finite.hpp"
#include "numerics/root.hpp"
#include "numerics/tails.hpp"

namespace ballbar {
namespace {

constexpr double kDisagree = 0.01;  // p

bool tells(const MachineTest& test) { return test.scales || test.squareness; }

// Whether the left one is less relevant: stored values before sigmas, no date before any.
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
  for (const Plane plane : kPlanes) {
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
    found.files.push_back(tests[i].file);
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

// Two equations a test: the scales of its axes.
struct Equations {
  std::vector<std::size_t> tests;
  std::array<int, 3> column{-1, -1, -1};  // of the axes' unknowns
  Eigen::MatrixXd a;
  Eigen::VectorXd y;
  std::vector<Eigen::Matrix2d> covariance;

  Eigen::Index row(std::size_t k) const { return static_cast<Eigen::Index>(2 * k); }
};

struct Solved {
  Eigen::VectorXd scale;
  Eigen::MatrixXd covariance;
  double chi2 = 0.0;
};

// With a scatter of each equation added to the covariances.
Solved solved(const Equations& equations, double scatter_ppm) {
  const Eigen::Index axes = equations.a.cols();
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(axes, axes);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(axes);
  std::vector<Eigen::Matrix2d> weight;
  weight.reserve(equations.tests.size());
  for (std::size_t k = 0; k < equations.tests.size(); ++k) {
    const auto a = equations.a.middleRows<2>(equations.row(k));
    weight.emplace_back((equations.covariance[k] + scatter_ppm * scatter_ppm * Eigen::Matrix2d::Identity()).inverse());
    normal += a.transpose() * weight.back() * a;
    right += a.transpose() * (weight.back() * equations.y.segment<2>(equations.row(k)));
  }
  Solved solution;
  solution.covariance = normal.inverse();
  solution.scale = solution.covariance * right;
  const Eigen::VectorXd left = equations.y - equations.a * solution.scale;
  for (std::size_t k = 0; k < equations.tests.size(); ++k) {
    const Eigen::Vector2d part = left.segment<2>(equations.row(k));
    solution.chi2 += part.dot(weight[k] * part);
  }
  return solution;
}

// With which chi^2 is what it is on average, the degrees of freedom (Mandel and Paule).
double scatter_for(const Equations& equations, std::size_t degrees) {
  const auto expected = static_cast<double>(degrees);
  const auto is_below = [&](double scatter_ppm) { return solved(equations, scatter_ppm).chi2 > expected; };
  double high = 1.0;
  while (is_below(high) && high < 1e9) high *= 2.0;
  return root_between(is_below, 0.0, high).second;
}

// Of the axes that the tests reach; unweighted where no test has a covariance.
Equations equations_of(std::span<const MachineTest> tests, const std::vector<std::size_t>& set, bool weighted) {
  Equations equations;
  for (const std::size_t i : set) {
    if (tests[i].scales && (!weighted || has_covariance(*tests[i].scales))) equations.tests.push_back(i);
  }
  for (const std::size_t i : equations.tests) {
    for (const int axis : axes_of(tests[i].plane)) equations.column[static_cast<std::size_t>(axis)] = 0;
  }
  int axes = 0;
  for (int& place : equations.column) {
    if (place == 0) place = axes++;
  }
  const Eigen::Index rows = equations.row(equations.tests.size());
  equations.a = Eigen::MatrixXd::Zero(rows, axes);
  equations.y.resize(rows);
  equations.covariance.reserve(equations.tests.size());
  for (std::size_t k = 0; k < equations.tests.size(); ++k) {
    const MachineTest& test = tests[equations.tests[k]];
    const auto [a, b] = axes_of(test.plane);
    equations.a(equations.row(k), equations.column[static_cast<std::size_t>(a)]) = 1.0;
    equations.a(equations.row(k) + 1, equations.column[static_cast<std::size_t>(b)]) = 1.0;
    equations.y.segment<2>(equations.row(k)) << test.scales->a_ppm, test.scales->b_ppm;
    equations.covariance.push_back(weighted ? test.scales->covariance : Eigen::Matrix2d::Identity());
  }
  return equations;
}

// Each equation's residual over its sigma.
std::vector<ScalePull> pulls_of(std::span<const MachineTest> tests, const Equations& equations, const Solved& solution,
                                bool weighted) {
  std::vector<ScalePull> pulls;
  const Eigen::VectorXd left = equations.y - equations.a * solution.scale;
  for (std::size_t k = 0; k < equations.tests.size(); ++k) {
    const auto a = equations.a.middleRows<2>(equations.row(k));
    const Eigen::Matrix2d of_residual = equations.covariance[k] - a * solution.covariance * a.transpose();
    const MachineTest& test = tests[equations.tests[k]];
    const auto pair = axes_of(test.plane);
    for (int side = 0; side < 2; ++side) {
      const double variance = equations.covariance[k](side, side);
      constexpr double kRounding = 1e-9;  // an axis that one test alone tells leaves no residual
      const bool compared = weighted && of_residual(side, side) > kRounding * variance;
      const Eigen::Index row = equations.row(k) + side;
      pulls.push_back({test.file, test.plane, pair[static_cast<std::size_t>(side)], equations.y[row],
                       weighted ? std::sqrt(variance) : kUnknown,
                       compared ? left[row] / std::sqrt(of_residual(side, side)) : kUnknown});
    }
  }
  return pulls;
}

std::size_t planes_with(std::span<const MachineTest> tests, const Equations& equations, int axis) {
  std::set<Plane> planes;
  for (const std::size_t i : equations.tests) {
    const auto [a, b] = axes_of(tests[i].plane);
    if (a == axis || b == axis) planes.insert(tests[i].plane);
  }
  return planes.size();
}

void solve_scales(std::span<const MachineTest> tests, MachineGeometry& geometry) {
  bool weighted = false;
  for (const std::size_t i : geometry.tests) {
    weighted = weighted || (tests[i].scales && has_covariance(*tests[i].scales));
  }
  const Equations equations = equations_of(tests, geometry.tests, weighted);
  if (equations.tests.empty()) return;
  Solved solution = solved(equations, 0.0);
  ScaleAgreement& agreement = geometry.agreement;
  agreement.pulls = pulls_of(tests, equations, solution, weighted);
  if (weighted) {
    agreement.chi2 = solution.chi2;
    agreement.degrees = static_cast<std::size_t>(equations.a.rows() - equations.a.cols());
  }
  if (agreement.degrees > 0) {
    agreement.p_value = chi2_upper_tail(agreement.chi2, agreement.degrees);
    if (agreement.p_value < kDisagree) {
      agreement.scatter_ppm = scatter_for(equations, agreement.degrees);
      solution = solved(equations, agreement.scatter_ppm);
    }
  }
  for (int axis = 0; axis < 3; ++axis) {
    const int place = equations.column[static_cast<std::size_t>(axis)];
    if (place < 0) continue;
    const double sigma = weighted ? std::sqrt(solution.covariance(place, place)) : kUnknown;
    geometry.scales.push_back({axis, solution.scale[place], sigma, planes_with(tests, equations, axis)});
  }
}

}  // namespace

MachineGeometry machine_geometry(std::span<const MachineTest> tests) {
  MachineGeometry geometry;
  geometry.tests = newest_set(tests);
  geometry.within_a_day = within_a_day_of_each_other(tests, geometry.tests);
  for (const Plane plane : kPlanes) {
    if (auto found = squareness_in(tests, geometry.tests, plane)) geometry.squareness.push_back(std::move(*found));
  }
  solve_scales(tests, geometry);
  return geometry;
}

}  // namespace ballbar
