// Models with all parameters held: read the held values, or hold a model at the values of a fit.
#pragma once

#include <vector>

#include "ballbar/fit/fit.hpp"
#include "ballbar/model/model.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

// The values of a model whose parameters are all held, the constant first, in the form that predict() takes.
std::vector<FittedParameter> held_parameters(const Model& model);

// The model with every parameter held at the given value. `parameters`: the constant first, then term by term.
Model held_at(Model model, const std::vector<FittedParameter>& parameters);

// Lowest and highest value of each column that the terms read, each column once, in the order of the terms. Columns
// without a value are left out. Throws Error, with the nearest name, for a column that the data do not have.
std::vector<ColumnRange> ranges_of(const Model& model, const Series& data);

}  // namespace ballbar
