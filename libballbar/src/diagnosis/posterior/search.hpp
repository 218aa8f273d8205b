// Searches for the parameters of the model together with the likely sums of single effects.
#pragma once

#include <cstddef>
#include <vector>

#include "diagnosis/posterior/weighted_ascent.hpp"

namespace ballbar {

inline constexpr double kOfBackground = 20.0;  // d of the background if it replaces all effects

// Another mode: a sum of single effects that excludes an identity of the best one.
struct Mode {
  std::size_t without = 0;       // the excluded identity
  std::vector<std::size_t> set;  // the most likely identity of each of its single effects
};

struct SearchResult {
  Variant variant;
  Identities identities;
  WeightedAscent best;
  std::vector<Mode> modes;  // other modes that are nearly as likely
};

// largest: largest number of single effects; grid: covariances of noise. Shapes of likely effects between the points of
// the grid are added to the library.
SearchResult search_result(Problem& problem, std::size_t largest, const std::vector<Covariance>& grid);

}  // namespace ballbar
