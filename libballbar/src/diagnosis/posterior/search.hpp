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
  std::vector<std::size_t> fitted;      // signatures of the effects at the shapes that a fit has beside the model
  Identities identities;
  SumOfEffects sum;  // at the first covariance
};

// The mode to which the ascent leads from the fit of the model. largest: largest number of single effects. Shapes of
// likely effects between the points of the grid are added to the library.
SearchResult mode_of(Problem& problem, std::size_t largest);

// This mode and those that the ascent finds with each of its effects left out once, if they are nearly as likely as the
// likeliest, which is the first.
std::vector<SearchResult> likely_modes(Problem& problem, std::size_t largest, SearchResult first);

}  // namespace ballbar
