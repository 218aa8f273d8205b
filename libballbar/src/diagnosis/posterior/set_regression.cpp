#include "diagnosis/posterior/set_regression.hpp"

#include <numeric>
#include <utility>

#include "diagnosis/posterior/linearisation.hpp"

namespace ballbar {

SetRegression set_regression(const Whitening& whitening, LinearModel model, std::vector<Eigen::Index> widths,
                             const KnownScatter& known) {
  SetRegression result;
  result.white = whitened_rows(whitening, model.columns);
  result.gram = gram_of_white(whitening, result.white);
  result.solution = linear_solution(result.gram, model.is_flat, known);
  Eigen::Index next = model.columns.cols() - 1 - std::accumulate(widths.begin(), widths.end(), Eigen::Index{0});
  for (const Eigen::Index width : widths) {
    result.first.push_back(next);
    next += width;
  }
  result.width = std::move(widths);
  result.model = std::move(model);
  return result;
}

SetRegression set_regression(const Problem& problem, const Posterior& posterior, const EffectSet& set) {
  std::vector<Eigen::Index> widths;
  for (const std::size_t i : set.signatures) widths.push_back(problem.library.signatures[i].width);
  return set_regression(posterior.filters[set.filter].whitening,
                        with_signatures(problem, posterior.linearisations[set.linearisation].linear, set.signatures),
                        std::move(widths), problem.known);
}

}  // namespace ballbar
