#include "diagnosis/posterior/rivals.hpp"

#include <algorithm>
#include <numeric>

#include "ballbar/numerics/parallel.hpp"

namespace ballbar {

Rivals rivals_of(const Problem& problem, const Posterior& posterior, const EffectSet& set, std::size_t member) {
  const std::vector<Family>& families = problem.library.families;
  const std::vector<Signature>& signatures = problem.library.signatures;
  const std::size_t own = signatures[set.signatures[member]].family;
  Variant with = posterior.variants[set.variant];
  for (std::size_t k = 0; k < set.signatures.size(); ++k) {
    if (k == member) continue;
    const Signature& other = signatures[set.signatures[k]];
    const Eigen::Index p = with.pool.cols();
    with.pool.conservativeResize(Eigen::NoChange, p + other.width);
    with.pool.rightCols(other.width) = problem.signatures.middleCols(other.first, other.width);
    for (Eigen::Index j = 0; j < other.width; ++j) {
      with.line.columns.push_back(p + j);
      with.line.is_free.push_back(1);
    }
  }
  // Of one family after the other: its columns, then their products where it has several gains.
  std::vector<std::size_t> compared{own};
  for (std::size_t f = problem.effects; f < families.size(); ++f) compared.push_back(f);
  const std::size_t points = posterior.points.size();
  std::vector<std::vector<double>> evidence(compared.size(), std::vector<double>(points));
  in_parallel(points, [&](std::size_t g) {
    const Point& point = posterior.points[g];
    for (std::size_t k = 0; k < compared.size(); ++k) {
      const std::vector<std::size_t> chosen = shapes_of(families[compared[k]]);
      Eigen::Index all = 0;
      for (const std::size_t i : chosen) all += signatures[i].width;
      RowMajorMatrix columns(problem.signatures.rows(), all);
      Eigen::Index next = 0;
      for (const std::size_t i : chosen) {
        columns.middleCols(next, signatures[i].width) =
            problem.signatures.middleCols(signatures[i].first, signatures[i].width);
        next += signatures[i].width;
      }
      const Solved base = solved(gram_of(point.filter, with.pool, columns), with.line, problem.known);
      std::vector<double> shapes;
      Eigen::Index first = 0;
      for (const std::size_t i : chosen) {
        const Signature& one = signatures[i];
        std::vector<Eigen::Index> places(static_cast<std::size_t>(one.width));
        std::iota(places.begin(), places.end(), first);
        Eigen::MatrixXd left = products_of(point.filter, columns, places);
        const auto cross = base.cross.middleCols(first, one.width);
        left -= cross.transpose() * cross;
        const Eigen::VectorXd along = base.along.segment(first, one.width);
        shapes.push_back((one.family < problem.effects
                              ? log_evidence(base, left, along, 1.0 / static_cast<double>(one.width))
                              : log_evidence_of_forms(base, left, along)) +
                         problem.log_prior_of_shape[i]);
        first += one.width;
      }
      evidence[k][g] = log_sum(shapes) + point.covariance.log_prior;
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
