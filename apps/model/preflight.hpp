// What data could show, before any residual.
#pragma once

#include "model/model_options.hpp"

namespace ballbar {

// A table of all effects, of each target of the model. Throws Error where the data cannot be fitted.
void show_preflight(const ModelOptions& options, const Model& model, const ModelData& data, bool json);

}  // namespace ballbar
