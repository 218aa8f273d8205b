// The coefficient of an effect in the units of its user: um for each kelvin of one column, and what it comes to.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ballbar/drift/drift.hpp"
#include "ballbar/fit/fit.hpp"
#include "ballbar/model/model.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

struct Coefficient {
  std::string effect;    // label of its term
  std::string column;    // of the data
  std::string unit;      // "um/K"
  Estimate value;        // sigma NaN: held, or not known
  double span_K = 0.0;   // largest less smallest value of the column in the fitted rows
  double size_um = 0.0;  // largest less smallest value of the effect there
  // While the effect rises and while it falls, fitted apart with all other parameters at once, under the noise of the
  // fit. A change of direction is a turn by more than a fifth of its span. nullopt: one direction has less than a
  // fifth.
  std::optional<Estimate> rising, falling;
  double usual_low = 0.0, usual_high = 0.0;  // of |value|; both 0: not stated
  std::string usual;                         // where that range comes from
};

// Of each effect with one input and one gain in um/K. `fit` is that of the model on the data.
std::vector<Coefficient> coefficients_of(const Model& model, const Fit& fit, const Series& data);

bool is_usual(const Coefficient& coefficient);

}  // namespace ballbar
