#include "diagnosis/evidence/gauss_newton_fit.hpp"

#include <algorithm>
#include <cmath>

namespace ballbar {
namespace {

constexpr double kLongestStep = 0.7;  // reaches

struct At {
  BaseColumns columns;
  LinearSolution solution;
};

At at(const BaseModel& base, const std::vector<double>& parameters, const std::vector<std::size_t>& free,
      const Eigen::MatrixXd& times, const Whitening& filter, const KnownScatter& known, std::size_t fixed) {
  At result;
  result.columns = base.at(parameters, free, fixed);
  const Gram gram = gram_of(filter, pool_of(result.columns, times));
  result.solution = linear_solution(gram, line_of(result.columns, times.cols()), known);
  return result;
}

// The shapes moved by a share of the linear solution, with the gains of that solution.
std::vector<double> moved(const BaseModel& base, const At& now, std::vector<double> parameters, double share) {
  for (std::size_t k = 0; k < now.columns.columns.size(); ++k) {
    const BaseColumn& column = now.columns.columns[k];
    const double coefficient = now.solution.coefficients[static_cast<Eigen::Index>(k)];
    double& value = parameters[column.parameter];
    if (column.is_free()) {
      value = coefficient * column.scale;
      continue;
    }
    const double step = share * std::clamp(coefficient, -kLongestStep, kLongestStep);
    const Setting& setting = base.setting(column.parameter);
    const Parameter& parameter = base.parameter(column.parameter);
    const bool is_positive = value > 0.0 && parameter.lower >= 0.0 && parameter.unit != "1";
    value = std::clamp(is_positive ? value * std::exp(step * column.scale / value) : value + step * column.scale,
                       std::min(setting.lower, value), std::max(setting.upper, value));
  }
  return parameters;
}

}  // namespace

Line line_of(const BaseColumns& columns, Eigen::Index times) {
  Line line;
  for (std::size_t k = 0; k < columns.columns.size(); ++k) {
    line.columns.push_back(1 + static_cast<Eigen::Index>(k));
    line.is_free.push_back(columns.columns[k].is_free() ? 1 : 0);
  }
  for (Eigen::Index k = 0; k < times; ++k) {
    line.columns.push_back(1 + columns.values.cols() + k);
    line.is_free.push_back(0);
  }
  return line;
}

RowMajorMatrix pool_of(const BaseColumns& columns, const Eigen::MatrixXd& times) {
  RowMajorMatrix pool(columns.y.size(), 1 + columns.values.cols() + times.cols());
  pool.col(0) = columns.y;
  pool.middleCols(1, columns.values.cols()) = columns.values;
  pool.rightCols(times.cols()) = times;
  return pool;
}

GaussNewtonFit gauss_newton_fit(const BaseModel& base, std::vector<double> parameters,
                                const std::vector<std::size_t>& free, const Eigen::MatrixXd& times,
                                const Whitening& filter, const KnownScatter& known, Steps steps, std::size_t fixed) {
  At now = at(base, parameters, free, times, filter, known, fixed);
  for (int round = 0; round < steps.most; ++round) {
    double share = 1.0;
    bool better = false;
    for (int half = 0; half < 3 && !better; ++half, share *= 0.4) {
      const std::vector<double> next = moved(base, now, parameters, share);
      At there = at(base, next, free, times, filter, known, fixed);
      if (!(there.solution.square < now.solution.square) && half < 2) continue;
      if (!(there.solution.square <= now.solution.square * (1.0 + 1e-9))) break;
      better = now.solution.square - there.solution.square > steps.least_fall * now.solution.variance;
      parameters = next;
      now = std::move(there);
      break;
    }
    if (!better) break;
  }
  // Gains by the last solution.
  for (std::size_t k = 0; k < now.columns.columns.size(); ++k) {
    const BaseColumn& column = now.columns.columns[k];
    if (column.is_free())
      parameters[column.parameter] = now.solution.coefficients[static_cast<Eigen::Index>(k)] * column.scale;
  }
  return {std::move(parameters), now.solution.variance, now.solution.square};
}

}  // namespace ballbar
