// Which few signatures of a library together explain a residual best: not greedily, one after the other, but together.
#pragma once

#include <vector>

#include "diagnosis/search/max_score_null.hpp"
#include "diagnosis/signatures/signature_library.hpp"

namespace ballbar {

using Set = std::vector<std::size_t>;  // signatures

struct Subset {
  Set signatures;     // of different families
  double gain = 0.0;  // b' G^-1 b, fall of chi^2
  double net = 0.0;   // gain less the threshold of every effect in it
};

// All singles; all pairs of the strongest shapes of the strongest families of every effect, then of all shapes of the
// best 25 pairs of families; triples of these pairs with every family. The best by `net` first; of the same families
// only the best shapes. null: nullptr for net = gain - 10 for each effect.
std::vector<Subset> best_subsets(const SignatureLibrary& library, const Projected& projected, const MaxScoreNull* null,
                                 std::size_t largest = 3);

}  // namespace ballbar
