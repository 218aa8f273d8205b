// Searches for the parameters of the model together with the likely sums of single effects.
#pragma once

#include <cstddef>
#include <vector>

#include "diagnosis/posterior/weighted_ascent.hpp"

namespace ballbar {

// Another mode: a sum of single effects that excludes an identity of the best one.
struct Mode {
  std::size_t without = 0;       // the excluded identity
  std::vector<std::size_t> set;  // the most likely identity of each of its single effects
};

struct SearchResult {
  std::vector<Covariance> covariances;  // the likeliest of each kind of discrepancy
  Variant variant;
  Identities identities;
  WeightedAscent best;
  std::vector<Mode> modes;  // other modes that are nearly as likely
};

// largest: largest number of single effects. Shapes of likely effects between the points of the grid are added to the
// library; readings far from the others, and jumps of the target, are noted in the problem.
SearchResult search_result(Problem& problem, std::size_t largest);

}  // namespace ballbar
