#include "diagnosis/search/best_subset.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <string>

#include "ballbar/diagnosis/statistics/thresholds.hpp"
#include "ballbar/numerics/parallel.hpp"
#include "numerics/orthonormal.hpp"

namespace ballbar {
namespace {

class Search {
 public:
  Search(const SignatureLibrary& library, const Projected& projected, const MaxScoreNull* null)
      : library_(library), projected_(projected) {
    along_ = projected.columns.transpose() * projected.residual;
    scores_ = scores(library, projected, projected.residual);
    for (const Family& family : library.families) {
      threshold_.push_back(null != nullptr ? null->threshold(*family.bound.effect) : kPriceInSearch);
    }
  }

  const Signature& at(std::size_t index) const { return library_.signatures[index]; }
  double score(std::size_t index) const { return scores_[static_cast<Eigen::Index>(index)]; }
  double threshold(std::size_t index) const { return threshold_[at(index).family]; }

  auto block(std::size_t index) const { return projected_.columns.middleCols(at(index).first, at(index).width); }
  auto along(std::size_t index) const { return along_.segment(at(index).first, at(index).width); }

  // U_a' U_b
  Eigen::MatrixXd between(std::size_t a, std::size_t b) const { return block(a).transpose() * block(b); }

  // Gain of b beside a: |(I - C'C)^-1/2 (b_b - C' b_a)|^2 + |b_a|^2; 0 where they are the same direction.
  double pair_gain(std::size_t a, std::size_t b, const Eigen::MatrixXd& c) const {
    if (c.size() == 1) {
      const double coherence = c(0, 0);
      if (std::abs(coherence) > kSameDirection) return 0.0;
      const double left = along(b)[0] - coherence * along(a)[0];
      return score(a) + left * left / (1.0 - coherence * coherence);
    }
    const Eigen::MatrixXd left = Eigen::MatrixXd::Identity(c.cols(), c.cols()) - c.transpose() * c;
    if (left.determinant() < 1.0 - kSameDirection * kSameDirection) return 0.0;
    const Eigen::VectorXd rest = along(b) - c.transpose() * along(a);
    return score(a) + rest.dot(left.ldlt().solve(rest));
  }

  Subset made(std::vector<std::size_t> signatures, double gain) const {
    Subset subset{std::move(signatures), gain, gain};
    for (const std::size_t index : subset.signatures) subset.net -= threshold(index);
    return subset;
  }

  std::vector<std::size_t> best_of_every_family() const {
    std::vector<std::size_t> best;
    for (const Family& family : library_.families) {
      std::size_t most = family.first;
      for (std::size_t i = family.first; i < family.first + family.count; ++i) {
        if (score(i) > score(most)) most = i;
      }
      if (score(most) > 0.0) best.push_back(most);  // else the model makes all of it already
    }
    return best;
  }

  // The strongest shapes of the strongest families of every effect, and some shapes evenly from the grid.
  std::vector<std::size_t> reduced() const {
    std::map<std::string, std::vector<std::size_t>> of_effect;  // by name
    for (const std::size_t best : best_of_every_family()) {
      of_effect[library_.families[at(best).family].bound.effect->name].push_back(best);
    }
    std::vector<std::size_t> result;
    for (auto& [effect, bests] : of_effect) {
      const auto stronger = [&](std::size_t a, std::size_t b) {
        return score(a) - threshold(a) > score(b) - threshold(b);
      };
      std::stable_sort(bests.begin(), bests.end(), stronger);
      bests.resize(std::min(bests.size(), kFamiliesOfAnEffect));
      for (const std::size_t best : bests) {
        const Family& family = library_.families[at(best).family];
        std::vector<std::size_t> shapes(family.count);
        std::iota(shapes.begin(), shapes.end(), family.first);
        std::stable_sort(shapes.begin(), shapes.end(), stronger);
        const std::size_t strongest = std::min(shapes.size(), kShapesOfAFamily / 2);
        std::vector<std::size_t> taken(shapes.begin(), shapes.begin() + static_cast<std::ptrdiff_t>(strongest));
        const std::size_t stride = std::max<std::size_t>(1, family.count / (kShapesOfAFamily / 2));
        for (std::size_t i = family.first + stride / 2; i < family.first + family.count; i += stride) {
          if (std::find(taken.begin(), taken.end(), i) == taken.end()) taken.push_back(i);
        }
        result.insert(result.end(), taken.begin(), taken.end());
      }
    }
    return result;
  }

  // All shapes of two families.
  Subset best_pair(const Family& a, const Family& b) const {
    const Eigen::Index first_a = at(a.first).first, first_b = at(b.first).first;
    const Signature &last_a = at(a.first + a.count - 1), &last_b = at(b.first + b.count - 1);
    const Eigen::MatrixXd gram =
        projected_.columns.middleCols(first_a, last_a.first + last_a.width - first_a).transpose() *
        projected_.columns.middleCols(first_b, last_b.first + last_b.width - first_b);
    Subset best;
    for (std::size_t i = a.first; i < a.first + a.count; ++i) {
      for (std::size_t j = b.first; j < b.first + b.count; ++j) {
        const double gain =
            pair_gain(i, j, gram.block(at(i).first - first_a, at(j).first - first_b, at(i).width, at(j).width));
        if (gain > best.gain) best = made({i, j}, gain);
      }
    }
    return best;
  }

  const SignatureLibrary& signatures() const { return library_; }
  const Projected& projected() const { return projected_; }

 private:
  const SignatureLibrary& library_;
  const Projected& projected_;
  Eigen::VectorXd along_, scores_;
  std::vector<double> threshold_;  // of each family
};

bool better(const Subset& a, const Subset& b) { return a.net > b.net; }

std::vector<std::size_t> families_of(const Search& search, const Subset& subset) {
  std::vector<std::size_t> families;
  for (const std::size_t index : subset.signatures) families.push_back(search.at(index).family);
  std::sort(families.begin(), families.end());
  return families;
}

// The best of each set of families.
void keep_best(const Search& search, std::vector<Subset>& subsets, std::size_t most) {
  std::stable_sort(subsets.begin(), subsets.end(), better);
  std::vector<std::vector<std::size_t>> seen;
  std::vector<Subset> kept;
  for (Subset& subset : subsets) {
    if (kept.size() == most) break;
    std::vector<std::size_t> families = families_of(search, subset);
    if (std::find(seen.begin(), seen.end(), families) != seen.end()) continue;
    seen.push_back(std::move(families));
    kept.push_back(std::move(subset));
  }
  subsets = std::move(kept);
}

std::vector<Subset> best_pairs(const Search& search, const std::vector<std::size_t>& reduced) {
  const auto width = [&] {
    Eigen::Index columns = 0;
    for (const std::size_t index : reduced) columns += search.at(index).width;
    return columns;
  }();
  Eigen::MatrixXd columns(search.projected().columns.rows(), width);
  std::vector<Eigen::Index> offset;
  Eigen::Index at = 0;
  for (const std::size_t index : reduced) {
    offset.push_back(at);
    columns.middleCols(at, search.at(index).width) = search.block(index);
    at += search.at(index).width;
  }
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(width, width);
  constexpr Eigen::Index kTogether = 64;
  in_parallel(static_cast<std::size_t>((width + kTogether - 1) / kTogether), [&](std::size_t batch) {
    const Eigen::Index first = kTogether * static_cast<Eigen::Index>(batch), now = std::min(kTogether, width - first);
    gram.block(0, first, first + now, now).noalias() =
        columns.leftCols(first + now).transpose() * columns.middleCols(first, now);
  });
  // The best pair of every two families.
  std::map<std::pair<std::size_t, std::size_t>, Subset> best;
  for (std::size_t i = 0; i < reduced.size(); ++i) {
    const Signature& a = search.at(reduced[i]);
    for (std::size_t j = i + 1; j < reduced.size(); ++j) {
      const Signature& b = search.at(reduced[j]);
      if (a.family == b.family) continue;
      const double gain = search.pair_gain(reduced[i], reduced[j], gram.block(offset[i], offset[j], a.width, b.width));
      if (!(gain > 0.0)) continue;
      Subset& known = best[{a.family, b.family}];
      if (gain > known.gain) known = search.made({reduced[i], reduced[j]}, gain);
    }
  }
  std::vector<Subset> pairs;
  pairs.reserve(best.size());
  for (auto& [families, subset] : best) pairs.push_back(std::move(subset));
  std::stable_sort(pairs.begin(), pairs.end(), better);
  pairs.resize(std::min(pairs.size(), kPairsOfFamilies));
  in_parallel(pairs.size(), [&](std::size_t k) {
    Subset& pair = pairs[k];
    if (pair.signatures.size() < 2) return;
    const Subset finer = search.best_pair(search.signatures().families[search.at(pair.signatures[0]).family],
                                          search.signatures().families[search.at(pair.signatures[1]).family]);
    if (finer.net > pair.net) pair = finer;
  });
  return pairs;
}

// One more signature beside those of a subset: gain of what of it is orthogonal to them.
std::vector<Subset> with_one_more(const Search& search, const Subset& subset, const std::vector<std::size_t>& reduced) {
  Eigen::Index width = 0;
  for (const std::size_t index : subset.signatures) width += search.at(index).width;
  Eigen::MatrixXd together(search.projected().columns.rows(), width);
  Eigen::Index at = 0;
  for (const std::size_t index : subset.signatures) {
    together.middleCols(at, search.at(index).width) = search.block(index);
    at += search.at(index).width;
  }
  const Eigen::MatrixXd basis = orthonormal(together);
  const Eigen::VectorXd along = basis.transpose() * search.projected().residual;
  const std::vector<std::size_t> families = families_of(search, subset);
  std::vector<Subset> result;
  for (const std::size_t index : reduced) {
    if (std::find(families.begin(), families.end(), search.at(index).family) != families.end()) continue;
    const Eigen::MatrixXd c = basis.transpose() * search.block(index);
    const Eigen::MatrixXd left = Eigen::MatrixXd::Identity(c.cols(), c.cols()) - c.transpose() * c;
    if (left.determinant() < 1.0 - kSameDirection * kSameDirection) continue;
    const Eigen::VectorXd rest = search.along(index) - c.transpose() * along;
    std::vector<std::size_t> signatures = subset.signatures;
    signatures.push_back(index);
    result.push_back(search.made(std::move(signatures), along.squaredNorm() + rest.dot(left.ldlt().solve(rest))));
  }
  return result;
}

}  // namespace

std::vector<Subset> best_subsets(const SignatureLibrary& library, const Projected& projected, const MaxScoreNull* null,
                                 std::size_t largest) {
  const Search search(library, projected, null);
  std::vector<Subset> all;
  for (const std::size_t index : search.best_of_every_family())
    all.push_back(search.made({index}, search.score(index)));
  if (largest >= 2 && library.families.size() >= 2) {
    const std::vector<std::size_t> reduced = search.reduced();
    std::vector<Subset> pairs = best_pairs(search, reduced);
    std::vector<Subset> triples;
    std::vector<std::vector<Subset>> more(largest < 3 ? 0 : pairs.size());
    in_parallel(more.size(), [&](std::size_t k) {
      if (pairs[k].signatures.size() < 2) return;
      more[k] = with_one_more(search, pairs[k], reduced);
      keep_best(search, more[k], kTriplesOfAPair);
    });
    for (std::vector<Subset>& some : more) std::move(some.begin(), some.end(), std::back_inserter(triples));
    std::move(pairs.begin(), pairs.end(), std::back_inserter(all));
    std::move(triples.begin(), triples.end(), std::back_inserter(all));
  }
  keep_best(search, all, kSubsetsKept);
  return all;
}

}  // namespace ballbar
