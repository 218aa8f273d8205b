#include "diagnosis/posterior/seen.hpp"

#include <numeric>
#include <utility>

#include "ballbar/diagnosis/thresholds.hpp"

namespace ballbar {

Chosen chosen_of(const Problem& problem, std::vector<std::size_t> signatures) {
  Chosen chosen;
  Eigen::Index next = 0;
  chosen.first.reserve(signatures.size());
  chosen.width.reserve(signatures.size());
  for (const std::size_t i : signatures) {
    chosen.first.push_back(next);
    chosen.width.push_back(problem.library.signatures[i].width);
    next += chosen.width.back();
  }
  chosen.columns.resize(problem.signatures.rows(), next);
  for (std::size_t k = 0; k < signatures.size(); ++k) {
    const Eigen::Index from = problem.library.signatures[signatures[k]].first;
    chosen.columns.middleCols(chosen.first[k], chosen.width[k]) = problem.signatures.middleCols(from, chosen.width[k]);
  }
  chosen.signatures = std::move(signatures);
  return chosen;
}

std::vector<std::size_t> thinned_shapes(const Family& family, std::size_t most) {
  const std::size_t stride = 1 + (family.count - 1) / most;
  std::vector<std::size_t> result;
  result.reserve(family.count / stride + 1 + family.more.size());
  for (std::size_t i = family.first + (stride - 1) / 2; i < family.first + family.count; i += stride)
    result.push_back(i);
  result.insert(result.end(), family.more.begin(), family.more.end());
  return result;
}

bool Seen::survives(Eigen::Index column) const { return base.left[column] > kSurvivingShare * whole[column]; }

Seen seen_at(const Problem& problem, const Point& point, const Variant& variant, const RowMajorMatrix& columns) {
  Gram gram = gram_of(point.filter, variant.pool, columns);
  Solved base = solved(gram, variant.line, problem.known);
  return {std::move(base), std::move(gram.squares), {}};
}

Seen seen_with_products(const Problem& problem, const Point& point, const Variant& variant,
                        const RowMajorMatrix& columns) {
  Seen seen = seen_at(problem, point, variant, columns);
  std::vector<Eigen::Index> every(static_cast<std::size_t>(columns.cols()));
  std::iota(every.begin(), every.end(), Eigen::Index{0});
  seen.left = products_of(point.filter, columns, every);
  seen.left.noalias() -= seen.base.cross.transpose() * seen.base.cross;
  return seen;
}

double log_evidence_of_curve(const Problem& problem, const Point& point, const Solved& base,
                             const RowMajorMatrix& columns, Eigen::Index first, std::size_t signature) {
  const Signature& one = problem.library.signatures[signature];
  std::vector<Eigen::Index> own(static_cast<std::size_t>(one.width));
  std::iota(own.begin(), own.end(), first);
  Eigen::MatrixXd left = products_of(point.filter, columns, own);
  const auto cross = base.cross.middleCols(first, one.width);
  left -= cross.transpose() * cross;
  const Eigen::VectorXd along = base.along.segment(first, one.width);
  return one.family < problem.effects ? log_evidence(base, left, along, 1.0 / static_cast<double>(one.width))
                                      : log_evidence_of_forms(base, left, along);
}

double log_evidence_of_seen(const Problem& problem, const Point& point, const Seen& seen, const RowMajorMatrix& columns,
                            Eigen::Index first, std::size_t signature) {
  if (!seen.survives(first)) return kLogZero;
  if (problem.library.signatures[signature].width == 1)
    return log_evidence(seen.base, seen.base.left[first], seen.base.along[first]);
  return log_evidence_of_curve(problem, point, seen.base, columns, first, signature);
}

double log_evidence_of_set(const Chosen& chosen, const Seen& seen, const std::vector<std::size_t>& places) {
  std::vector<Eigen::Index> columns;
  for (const std::size_t place : places) {
    for (Eigen::Index k = 0; k < chosen.width[place]; ++k) columns.push_back(chosen.first[place] + k);
  }
  return log_evidence(seen.base, seen.left(columns, columns), seen.base.along(columns));
}

double log_evidence_of_pair(const Chosen& chosen, const Seen& seen, std::size_t i, std::size_t j) {
  if (chosen.width[i] > 1 || chosen.width[j] > 1) return log_evidence_of_set(chosen, seen, {i, j});
  const Eigen::Index a = chosen.first[i], b = chosen.first[j];
  return log_evidence_of_two(seen.base, seen.left(a, a), seen.left(b, b), seen.left(a, b), seen.base.along[a],
                             seen.base.along[b]);
}

}  // namespace ballbar
