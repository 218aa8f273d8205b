#include "diagnosis/verdict/coarse_columns.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <utility>

#include "numerics/orthonormal.hpp"
#include "series/resolution.hpp"

namespace ballbar {
namespace {

constexpr double kOfRounding = 1.5;    // times the standard deviation of a rounded value
constexpr double kOverRounding = 2.0;  // times that: the least of an input that can be the cause

bool is_read(const std::vector<Candidate>& members, const std::string& column) {
  return std::any_of(members.begin(), members.end(), [&](const Candidate& member) {
    const std::vector<std::string>& columns = member.bound.columns;
    return member.in_best_set && std::find(columns.begin(), columns.end(), column) != columns.end();
  });
}

// Some members of the set: their curve, alone and with a slow drift, orthogonal to the columns of the base model and of
// all other members.
struct Part {
  Eigen::MatrixXd beside;  // orthonormal
  Eigen::VectorXd curve, with_slow;
};
Part part_of(const SetRegression& at, const std::vector<char>& is_in, const Eigen::VectorXd& slow_um) {
  Eigen::VectorXd curve = Eigen::VectorXd::Zero(at.model.columns.rows());
  std::vector<char> is_beside(at.model.is_flat.begin(), at.model.is_flat.end());  // of the base model
  for (std::size_t m = 0; m < at.first.size(); ++m) {
    const Eigen::Index first = at.first[m], width = at.width[m];
    std::fill_n(is_beside.begin() + first, width, is_in[m] != 0 ? char{0} : char{1});
    if (is_in[m] != 0)
      curve += at.model.columns.middleCols(1 + first, width) * at.solution.coefficients.segment(first, width);
  }
  std::vector<Eigen::Index> places;
  for (std::size_t k = 0; k < is_beside.size(); ++k)
    if (is_beside[k] != 0) places.push_back(1 + static_cast<Eigen::Index>(k));
  Part part{orthonormal(Eigen::MatrixXd(at.model.columns(Eigen::all, places))), {}, {}};
  part.curve = orthogonal_part(std::move(curve), part.beside);
  part.with_slow = part.curve + orthogonal_part(slow_um, part.beside);
  return part;
}

// Each member, and all of them.
std::vector<Part> parts_of(const SetRegression& at, const Eigen::VectorXd& slow_um) {
  const std::size_t members = at.first.size();
  std::vector<Part> parts;
  parts.reserve(members + 1);
  for (std::size_t m = 0; m < members; ++m) {
    std::vector<char> is_in(members, 0);
    is_in[m] = 1;
    parts.push_back(part_of(at, is_in, slow_um));
  }
  if (members > 1) parts.push_back(part_of(at, std::vector<char>(members, 1), slow_um));
  return parts;
}

Eigen::VectorXd at_rows(const Column& column, const std::vector<std::size_t>& rows) {
  Eigen::VectorXd values(static_cast<Eigen::Index>(rows.size()));
  for (std::size_t i = 0; i < rows.size(); ++i) values[static_cast<Eigen::Index>(i)] = column.values[rows[i]];
  return values;
}

// Both orthogonal to the rest of the model. The input is larger than its rounding.
bool could_be(const Eigen::VectorXd& input, double resolution, const Eigen::VectorXd& curve) {
  const double square = input.squaredNorm(), n = static_cast<double>(curve.size());
  const double rounding = kOfRounding * resolution / std::sqrt(12.0);
  if (!(std::sqrt(square / n) > kOverRounding * rounding)) return false;
  const double gain = input.dot(curve) / square;
  const double left = std::sqrt((curve - gain * input).squaredNorm() / n);
  return left <= std::abs(gain) * rounding;
}

}  // namespace

std::vector<CoarseColumn> coarse_columns(const Problem& problem, const Series& data, const SetRegression& at,
                                         const Eigen::VectorXd& slow_um, const std::vector<Candidate>& members) {
  std::vector<CoarseColumn> found;
  if (problem.model.level != Level::series) return found;
  const std::vector<Part> parts = parts_of(at, slow_um);
  for (const LoggedInput& input : problem.logged.inputs) {
    const Column& read = *find_column(data, input.column);
    const double resolution = resolution_of(read.values);
    if (input.is_stepped || !(resolution > 0.0) || is_read(members, input.column)) continue;
    const Eigen::VectorXd readings = at_rows(read, problem.base.row);
    const bool could_be_one = std::any_of(parts.begin(), parts.end(), [&](const Part& part) {
      const Eigen::VectorXd left = orthogonal_part(readings, part.beside);
      return could_be(left, resolution, part.curve) || could_be(left, resolution, part.with_slow);
    });
    if (could_be_one) found.push_back({input.column, resolution});
  }
  return found;
}

}  // namespace ballbar
