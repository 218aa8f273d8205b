#include "diagnosis/evidence/shape_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace ballbar {
namespace {

// With the most likely gains, and the scatter beside them.
ShapeFit with_gains(const BaseModel& base, std::vector<double> parameters, const std::vector<std::size_t>& free,
                    const Eigen::MatrixXd& open, const Whitening& filter, const KnownScatter& known,
                    std::size_t fixed) {
  const BaseColumns columns = base.at(parameters, free, fixed);
  const LinearSolution solution = linear_solution(filter, linear_model_of(columns, open), known);
  for (std::size_t k = 0; k < columns.columns.size(); ++k) {
    const BaseColumn& column = columns.columns[k];
    if (column.is_flat())
      parameters[column.parameter] = solution.coefficients[static_cast<Eigen::Index>(k)] * column.scale;
  }
  return {std::move(parameters), solution.variance, solution.square};
}

// Bounds that hold what does not move; a start beyond a bound is one.
Bounds bounds_at(const BaseModel& base, const std::vector<double>& parameters, const std::vector<std::size_t>& free,
                 std::size_t fixed) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  const auto count = static_cast<Eigen::Index>(parameters.size());
  Bounds bounds{Eigen::VectorXd::Constant(count, -kInfinite), Eigen::VectorXd::Constant(count, kInfinite),
                std::vector<bool>(parameters.size(), true)};
  bounds.held[0] = !base.is_constant_free();
  for (std::size_t k = 1; k < parameters.size(); ++k) {
    const Setting& setting = base.setting(k);
    const bool is_freed = std::find(free.begin(), free.end(), k) != free.end();
    // The readings determine no moment between two rows.
    const bool is_moment = base.parameter(k).shape_of == ShapeOf::onset;
    bounds.held[k] = (setting.held && !is_freed) || k == fixed || is_moment;
    bounds.lower[static_cast<Eigen::Index>(k)] = std::min(setting.lower, parameters[k]);
    bounds.upper[static_cast<Eigen::Index>(k)] = std::max(setting.upper, parameters[k]);
  }
  return bounds;
}

}  // namespace

LinearModel linear_model_of(const BaseColumns& columns, const Eigen::MatrixXd& open) {
  LinearModel linear;
  linear.columns.resize(columns.y.size(), 1);
  linear.columns.col(0) = columns.y;
  linear = with_columns(with_columns(std::move(linear), columns.values, false), open, false);
  for (std::size_t k = 0; k < columns.columns.size(); ++k) linear.is_flat[k] = columns.columns[k].is_flat() ? 1 : 0;
  return linear;
}

ShapeFit shape_fit(const BaseModel& base, std::vector<double> parameters, const std::vector<std::size_t>& free,
                   const Eigen::MatrixXd& open, const Whitening& filter, const KnownScatter& known, Stop stop,
                   std::size_t fixed) {
  const ShapeFit start = with_gains(base, std::move(parameters), free, open, filter, known, fixed);
  if (stop.most_iterations == 0) return start;
  const auto count = static_cast<Eigen::Index>(start.parameters.size());
  const Weighting weighting{Eigen::VectorXd::Ones(base.y().size()),
                            filter,
                            {},
                            {whitened_rows(filter, open), std::max(start.variance, 1e-300)}};
  const Minimum minimum = minimise(base.rows(), base.y(), weighting, bounds_at(base, start.parameters, free, fixed),
                                   Eigen::VectorXd::Map(start.parameters.data(), count), stop);
  if (!std::isfinite(minimum.cost)) return start;
  return with_gains(base, {minimum.parameters.begin(), minimum.parameters.end()}, free, open, filter, known, fixed);
}

}  // namespace ballbar
