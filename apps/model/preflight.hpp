// Which effects the data could show, before any residual is examined.
#pragma once

#include "model/model_options.hpp"

namespace ballbar {

// A table of all effects for each target of the model. Throws Error if the data cannot be fitted.
void show_preflight(const ModelOptions& options, const Model& model, const ModelData& data, bool json, bool details);

}  // namespace ballbar
