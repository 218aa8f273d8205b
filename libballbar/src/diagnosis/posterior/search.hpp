// Searches for the parameters of the model together with the likely sum of single effects.
#pragma once

#include <cstddef>
#include <vector>

#include "diagnosis/posterior/ibss.hpp"
#include "diagnosis/posterior/identities.hpp"

namespace ballbar {

struct SearchResult {
  std::vector<Covariance> covariances;  // the likeliest of each kind of discrepancy
  Linearisation linearisation;          // the model about its likeliest parameters
  std::vector<double> fitted_values;    // of each held value the one that a fit finds in its place
  Identities identities;
  SumOfEffects sum;  // at the first covariance
};

// largest: largest number of single effects. Shapes of likely effects between the points of the grid are added to the
// library.
SearchResult search_result(Problem& problem, std::size_t largest);

}  // namespace ballbar
