#include "diagnosis/posterior/rivals.hpp"

#include <algorithm>

#include "ballbar/numerics/parallel.hpp"
#include "diagnosis/posterior/seen.hpp"

namespace ballbar {

Rivals rivals_of(const Problem& problem, const Posterior& posterior, const EffectSet& set, std::size_t member) {
  const std::vector<Family>& families = problem.library.families;
  const std::size_t own = problem.library.signatures[set.signatures[member]].family;
  std::vector<std::size_t> others = set.signatures;
  others.erase(others.begin() + static_cast<std::ptrdiff_t>(member));
  const Variant with = with_signatures(problem, posterior.variants[set.variant], others);
  // Of one family after the other: its columns, then their products where it has several gains.
  std::vector<std::size_t> compared{own};
  for (std::size_t f = problem.effects; f < families.size(); ++f) compared.push_back(f);
  std::vector<Chosen> shapes;
  shapes.reserve(compared.size());
  for (const std::size_t f : compared) shapes.push_back(chosen_of(problem, shapes_of(families[f])));
  const std::size_t points = posterior.points.size();
  std::vector<std::vector<double>> evidence(compared.size(), std::vector<double>(points));
  in_parallel(points, [&](std::size_t g) {
    const Point& point = posterior.points[g];
    for (std::size_t k = 0; k < compared.size(); ++k) {
      const auto& [signatures, first, width, columns] = shapes[k];
      const Solved base = solved(gram_of(point.filter, with.pool, columns), with.line, problem.known);
      std::vector<double> of_shape;
      of_shape.reserve(signatures.size());
      for (std::size_t i = 0; i < signatures.size(); ++i) {
        of_shape.push_back(log_evidence_of_curve(problem, point, base, columns, first[i], signatures[i]) +
                           problem.log_prior_of_shape[signatures[i]]);
      }
      evidence[k][g] = log_sum(of_shape) + point.covariance.log_prior;
    }
  });
  Rivals result;
  result.member = log_sum(evidence[0]);
  for (std::size_t k = 1; k < compared.size(); ++k) {
    result.inputs.push_back({families[compared[k]].bound.columns.front(), log_sum(evidence[k])});
  }
  std::stable_sort(result.inputs.begin(), result.inputs.end(),
                   [](const Rival& a, const Rival& b) { return a.log_evidence > b.log_evidence; });
  return result;
}

}  // namespace ballbar
