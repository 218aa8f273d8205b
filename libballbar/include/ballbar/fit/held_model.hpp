// A model whose parameters are held: what it is held at, and one held at the values of a fit.
#pragma once

#include <vector>

#include "ballbar/fit/fit.hpp"
#include "ballbar/model/model.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

// What predict() takes for a model that is all held: the values it is held at, the constant first.
std::vector<FittedParameter> held_parameters(const Model& model);

// With the constant and every parameter held at these values, the constant first, then term by term.
Model held_at(Model model, const std::vector<FittedParameter>& parameters);

// Lowest and highest value of each column that the terms read, once a column, in their order; none for a column without
// a value. Throws Error for a column that the data do not have, with the nearest.
std::vector<ColumnRange> ranges_of(const Model& model, const Series& data);

}  // namespace ballbar
