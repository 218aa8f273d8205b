#include "diagnosis/posterior/linearisation.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "diagnosis/evidence/shape_fit.hpp"

namespace ballbar {

Linearisation linearisation_at(const Problem& problem, std::optional<std::size_t> freed,
                               std::vector<double> parameters) {
  Eigen::MatrixXd open = problem.base_model->delays_at(parameters, problem.tuning, problem.model.terms.size());
  return linearisation_at(problem, freed, std::move(parameters), with_levels(problem, std::move(open)));
}

Linearisation linearisation_at(const Problem& problem, std::optional<std::size_t> freed, std::vector<double> parameters,
                               Eigen::MatrixXd open) {
  LinearModel linear = linear_model_of(problem.base_model->at(parameters, free_of(problem, freed)), open);
  return {freed, std::move(parameters), std::move(open), std::move(linear)};
}

std::vector<std::size_t> free_of(const Problem& problem, std::optional<std::size_t> freed) {
  if (!freed) return {};
  return {problem.held[*freed].parameter};
}

LinearModel with_any_forms(const Problem& problem, LinearModel linear) {
  if (!problem.tuning.any_forms_first) return linear;
  constexpr Eigen::Index kEach = 3;  // of the columns of an input
  std::vector<Eigen::Index> columns;
  for (std::size_t f = problem.effects; f < problem.library.families.size(); ++f) {
    const Signature& one = problem.library.signatures[problem.library.families[f].first];
    for (Eigen::Index k = 0; k < one.width; k += kEach) columns.push_back(one.first + k);
  }
  const double size_um =
      std::sqrt(problem.y.squaredNorm() / static_cast<double>(std::max<Eigen::Index>(1, problem.y.size())));
  return with_columns(std::move(linear), size_um * problem.library.columns(Eigen::all, columns), false);
}

LinearModel with_signatures(const Problem& problem, LinearModel linear, const std::vector<std::size_t>& signatures) {
  for (const std::size_t i : signatures) {
    const Signature& one = problem.library.signatures[i];
    linear = with_columns(std::move(linear), problem.library.columns.middleCols(one.first, one.width), true);
  }
  return linear;
}

}  // namespace ballbar
