#include "diagnosis/verdict/coarse_columns.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "numerics/orthonormal.hpp"
#include "series/resolution.hpp"

namespace ballbar {
namespace {

constexpr double kOfRounding = 1.5;    // times the standard deviation of a rounded value
constexpr double kOverRounding = 2.0;  // times that: what is left of an input that can be the cause

// The columns of the base model and of the other members.
Eigen::MatrixXd beside(const SetRegression& at, std::size_t member) {
  std::vector<Eigen::Index> places;
  for (Eigen::Index k = 0; k < at.size(); ++k) {
    const bool is_own = k >= at.first[member] && k < at.first[member] + at.width[member];
    if (!is_own && (at.model.is_flat[static_cast<std::size_t>(k)] != 0 || k >= at.first.front()))
      places.push_back(1 + k);
  }
  return orthonormal(Eigen::MatrixXd(at.model.columns(Eigen::all, places)));
}

Eigen::VectorXd curve_of(const SetRegression& at, std::size_t member) {
  return at.model.columns.middleCols(1 + at.first[member], at.width[member]) *
         at.solution.coefficients.segment(at.first[member], at.width[member]);
}

Eigen::VectorXd at_rows(const Column& column, const std::vector<std::size_t>& rows) {
  Eigen::VectorXd values(static_cast<Eigen::Index>(rows.size()));
  for (std::size_t i = 0; i < rows.size(); ++i) values[static_cast<Eigen::Index>(i)] = column.values[rows[i]];
  return values;
}

// Both without what stands beside the member. What is left of the input is more than its rounding.
bool could_be(const Eigen::VectorXd& input, double resolution, const Eigen::VectorXd& curve) {
  const double square = input.squaredNorm(), n = static_cast<double>(curve.size());
  const double rounding = kOfRounding * resolution / std::sqrt(12.0);
  if (!(std::sqrt(square / n) > kOverRounding * rounding)) return false;
  const double gain = input.dot(curve) / square;
  const double left = std::sqrt((curve - gain * input).squaredNorm() / n);
  fprintf(stderr, "left %g gain %g rounding %g input %g curve %g\n", left, gain, rounding, std::sqrt(square / n),
          curve.norm() / std::sqrt(n));
  return left <= std::abs(gain) * rounding;
}

}  // namespace

std::vector<CoarseColumn> coarse_columns(const Problem& problem, const Series& data, const SetRegression& at,
                                         const Eigen::VectorXd& slow_um, const std::vector<Candidate>& members) {
  std::vector<CoarseColumn> found;
  if (problem.model.level != Level::series) return found;
  for (std::size_t m = 0; m < at.first.size(); ++m) {
    const Eigen::MatrixXd basis = beside(at, m);
    const Eigen::VectorXd curve = orthogonal_part(curve_of(at, m), basis), slow = orthogonal_part(slow_um, basis);
    for (const LoggedInput& input : problem.logged.inputs) {
      const std::vector<std::string>& own = members[m].bound.columns;
      const double resolution = resolution_of(find_column(data, input.column)->values);
      const auto is_it = [&](const CoarseColumn& one) { return one.column == input.column; };
      if (input.is_stepped || !(resolution > 0.0) || std::any_of(found.begin(), found.end(), is_it) ||
          std::find(own.begin(), own.end(), input.column) != own.end())
        continue;
      const Column& smooth = *find_column(problem.logged.series, input.column);
      const Eigen::VectorXd left = orthogonal_part(at_rows(smooth, problem.base.row), basis);
      if (could_be(left, resolution, curve) || could_be(left, resolution, curve + slow))
        found.push_back({input.column, resolution});
    }
  }
  return found;
}

}  // namespace ballbar
