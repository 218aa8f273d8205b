// Fits a model of recordings whose effects are errors of the machine. Each error has its value from the joint fit of
// all errors, whether the model has the others or not, so that it is the same in every model (machine_errors.hpp).
#pragma once

#include "ballbar/fit/fit.hpp"
#include "machine_errors/error_fit.hpp"

namespace ballbar {

// errors: joint_error_fit(data, {}). The circles are fitted with the errors of the model.
Fit fit_of_machine_errors(const Model& model, const Series& data, std::size_t target, const JointErrorFit& errors);

}  // namespace ballbar
