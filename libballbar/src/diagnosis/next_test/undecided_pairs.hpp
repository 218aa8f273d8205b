// The pairs of candidates of a diagnosis that a test should separate.
#pragma once

#include <cstddef>
#include <vector>

#include "ballbar/diagnosis/verdict/diagnosis.hpp"
#include "ballbar/model/model.hpp"
#include "ballbar/series/series.hpp"
#include "diagnosis/next_test/discrimination_matrix.hpp"

namespace ballbar {

// Indices into DiscriminationMatrix::competitors; `others`: those of the rest of the best set, fitted with them.
struct Pair {
  std::size_t a = 0, b = 0;
  std::vector<std::size_t> others;
};

struct UndecidedPairs {
  DiscriminationMatrix candidates;
  std::vector<Pair> pairs;
};

// Pairs within the groups of the diagnosis. A group of one is paired with a copy that does not occur again. Without
// groups the two strongest candidates that are not named. Keeps references to all three arguments.
UndecidedPairs undecided_pairs_of(const Model& model, const Series& data, const Diagnosis& diagnosis);

}  // namespace ballbar
