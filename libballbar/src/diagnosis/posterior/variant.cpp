#include "diagnosis/posterior/variant.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "diagnosis/evidence/shape_fit.hpp"

namespace ballbar {

Variant variant_at(const Problem& problem, std::size_t own, std::vector<double> parameters) {
  Eigen::MatrixXd times = problem.base_model->times_at(parameters);
  if (!problem.tuning.input_times) times.resize(times.rows(), 0);
  times = with_levels(problem, std::move(times));
  return variant_at(problem, own, std::move(parameters), std::move(times));
}

Variant variant_at(const Problem& problem, std::size_t own, std::vector<double> parameters, Eigen::MatrixXd times) {
  const BaseColumns columns = problem.base_model->at(parameters, free_of(problem, own));
  RowMajorMatrix pool = pool_of(columns, times);
  Line line = line_of(columns, times.cols());
  return {own, std::move(parameters), std::move(times), std::move(pool), std::move(line)};
}

std::vector<std::size_t> free_of(const Problem& problem, std::size_t own) {
  if (own == 0) return {};
  return {problem.own[own - 1].parameter};
}

Variant beside_any_forms(const Problem& problem, Variant variant) {
  if (!problem.tuning.any_forms_first) return variant;
  constexpr Eigen::Index kEach = 3;  // of the columns of an input
  std::vector<Eigen::Index> columns;
  for (std::size_t f = problem.effects; f < problem.library.families.size(); ++f) {
    const Signature& one = problem.library.signatures[problem.library.families[f].first];
    for (Eigen::Index k = 0; k < one.width; k += kEach) columns.push_back(one.first + k);
  }
  const double size_um =
      std::sqrt(problem.y.squaredNorm() / static_cast<double>(std::max<Eigen::Index>(1, problem.y.size())));
  Eigen::Index next = variant.pool.cols();
  variant.pool.conservativeResize(Eigen::NoChange, next + static_cast<Eigen::Index>(columns.size()));
  for (const Eigen::Index column : columns) {
    variant.pool.col(next) = size_um * problem.signatures.col(column);
    variant.line.columns.push_back(next++);
    variant.line.is_free.push_back(0);
  }
  return variant;
}

Variant with_signatures(const Problem& problem, Variant variant, const std::vector<std::size_t>& signatures) {
  Eigen::Index next = variant.pool.cols(), width = 0;
  for (const std::size_t i : signatures) width += problem.library.signatures[i].width;
  variant.pool.conservativeResize(Eigen::NoChange, next + width);
  for (const std::size_t i : signatures) {
    const Signature& one = problem.library.signatures[i];
    variant.pool.middleCols(next, one.width) = problem.signatures.middleCols(one.first, one.width);
    for (Eigen::Index k = 0; k < one.width; ++k) {
      variant.line.columns.push_back(next++);
      variant.line.is_free.push_back(1);
    }
  }
  return variant;
}

}  // namespace ballbar
