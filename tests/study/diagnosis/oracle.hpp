// What the data allow: how much worse the best wrong answer would be.
//
// Every hidden effect in turn is left out and imitated by one of another family (another effect, or the same on other
// columns; not one that at the edge of its shapes becomes the hidden one) with the best shape of its grid and free
// gains, beside the base model and the other hidden effects with free gains. With d the norm of the hidden signal,
// whitened by the true noise and freed of all of these, and rho the largest correlation with such a competitor, the
// competitor explains the data worse by
//
//   loss = d^2 (1 - rho^2)      2 ln L, expected, without noise
//
// The smallest loss of all hidden effects tells whether any diagnosis could be right: from 20 on they are `separable`.
// Where noise is, the loss scatters by 2 sqrt(loss).
#pragma once

#include <string>

#include "data_set.hpp"

namespace ballbar::study {

constexpr double kSeparable = 20.0;

struct Oracle {
  double loss = 0.0;
  std::string competitor;
};

// Of what is not in the catalogue: the loss by the one effect that imitates it best.
Oracle oracle(const DataSet& set);

}  // namespace ballbar::study
