// Where the model has its parameters beside what is missing, and which sums of single effects are likely there.
#pragma once

#include <cstddef>
#include <vector>

#include "diagnosis/posterior/found.hpp"

namespace ballbar {

inline constexpr double kOfBackground = 20.0;  // d of it where it stands for all effects

// A sum of single effects that is no neighbour of the best one: without an identity of it.
struct Mode {
  std::size_t without = 0;       // that identity
  std::vector<std::size_t> set;  // the likeliest identity of each of its single effects
};

struct Searched {
  Variant variant;
  Identities identities;
  Found best;
  std::vector<Mode> modes;  // nearly as likely
};

// largest: number of single effects; grid: covariances of noise. Shapes of likely effects between those of the grid are
// added to the library.
Searched searched(Problem& problem, std::size_t largest, const std::vector<Covariance>& grid);

}  // namespace ballbar
