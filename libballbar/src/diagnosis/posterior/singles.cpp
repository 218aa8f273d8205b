#include "diagnosis/posterior/singles.hpp"

#include <map>
#include <numeric>
#include <utility>

#include "ballbar/numerics/parallel.hpp"
#include "diagnosis/posterior/seen.hpp"
#include "diagnosis/posterior/set_prior.hpp"

namespace ballbar {
namespace {

// Every shape of a family, its columns as seen. first: of every signature of the library its first column.
FoundSet found_single(const Problem& problem, const Point& point, const Seen& seen, const RowMajorMatrix& columns,
                      const std::vector<Eigen::Index>& first, std::size_t family, double prior) {
  FoundSet found;
  std::vector<double> shapes;
  for (const std::size_t i : shapes_of(problem.library.families[family])) {
    const double evidence = log_evidence_of_seen(problem, point, seen, columns, first[i], i);
    if (evidence == kLogZero) continue;
    shapes.push_back(evidence + prior + problem.log_prior_of_shape[i]);
    if (shapes.back() > found.most) {
      found.most = shapes.back();
      found.signatures = {i};
    }
  }
  found.log_weight = log_sum(shapes);
  return found;
}

void weigh_families(const Problem& problem, SetTable& table, std::size_t v, const std::vector<std::size_t>& families,
                    const RowMajorMatrix& columns, const std::vector<Eigen::Index>& first) {
  const Variant& variant = table.variants[v];
  std::vector<std::size_t> every(table.points.size());
  std::iota(every.begin(), every.end(), std::size_t{0});
  std::vector<std::map<SetKey, FoundSet>> found(every.size());
  in_parallel(every.size(), [&](std::size_t g) {
    const Point& point = table.points[g];
    const Seen seen = seen_at(problem, point, variant, columns);
    const double alone =
        log_evidence(seen.base) + log_prior_of_set(problem, {}, variant.own) + point.covariance.log_prior;
    found[g][{variant.own, {}}] = {alone, alone, {}};
    for (const std::size_t f : families) {
      const double prior = log_prior_of_set(problem, {f}, variant.own) + point.covariance.log_prior;
      found[g][{variant.own, {f}}] = found_single(problem, point, seen, columns, first, f, prior);
    }
  });
  table.add(every, v, std::move(found));
}

}  // namespace

void weigh_singles(const Problem& problem, SetTable& table, std::size_t variant) {
  std::vector<std::size_t> families(problem.library.families.size());
  std::iota(families.begin(), families.end(), std::size_t{0});
  std::vector<Eigen::Index> first;
  first.reserve(problem.library.signatures.size());
  for (const Signature& one : problem.library.signatures) first.push_back(one.first);
  weigh_families(problem, table, variant, families, problem.signatures, first);
}

void weigh_singles(const Problem& problem, SetTable& table, std::size_t variant,
                   const std::vector<std::size_t>& families) {
  std::vector<std::size_t> shapes;
  for (const std::size_t family : families) {
    const std::vector<std::size_t> more = shapes_of(problem.library.families[family]);
    shapes.insert(shapes.end(), more.begin(), more.end());
  }
  const Chosen chosen = chosen_of(problem, std::move(shapes));
  std::vector<Eigen::Index> first(problem.library.signatures.size());
  for (std::size_t k = 0; k < chosen.signatures.size(); ++k) first[chosen.signatures[k]] = chosen.first[k];
  weigh_families(problem, table, variant, families, chosen.columns, first);
}

}  // namespace ballbar
