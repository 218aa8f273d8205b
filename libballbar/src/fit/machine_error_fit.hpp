// A model of recordings whose effects are errors of the machine: each is fitted beside all of them, whether the model
// has them or not, so that an effect has one value in every model (machine_errors.hpp).
#pragma once

#include "ballbar/fit/fit.hpp"
#include "machine_errors/error_fit.hpp"

namespace ballbar {

// errors: error_fitted(data, {}). The circles are those that fit best beside the errors of the model.
Fit fit_of_machine_errors(const Model& model, const Series& data, std::size_t target, const ErrorFitted& errors);

}  // namespace ballbar
