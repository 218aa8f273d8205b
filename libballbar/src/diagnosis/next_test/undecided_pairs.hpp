// Which candidates of a diagnosis a test has to tell apart.
#pragma once

#include <cstddef>
#include <vector>

#include "ballbar/diagnosis/verdict/diagnosis.hpp"
#include "ballbar/model/model.hpp"
#include "ballbar/series/series.hpp"
#include "diagnosis/next_test/discrimination_matrix.hpp"

namespace ballbar {

// Indices of DiscriminationMatrix::competitors; `others`: of the rest of the best set, fitted beside them.
struct Pair {
  std::size_t a = 0, b = 0;
  std::vector<std::size_t> others;
};

struct UndecidedPairs {
  DiscriminationMatrix candidates;
  std::vector<Pair> pairs;
};

// Pairs within the groups of the diagnosis; a group of one is paired with itself as what does not come again. Without
// groups the strongest two candidates that are not named. Refers to all three arguments.
UndecidedPairs undecided_pairs_of(const Model& model, const Series& data, const Diagnosis& diagnosis);

}  // namespace ballbar
