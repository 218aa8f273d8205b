// The workbench of a request.
#pragma once

#include <memory>

#include "ballbar/workbench/workbench.hpp"
#include "model/model_options.hpp"

namespace ballbar {

// model: of one target. Throws Error where the model does not suit the data, with the file that is at fault.
Workbench workbench_of(const ModelOptions& options, const std::shared_ptr<const ModelData>& data, const Model& model,
                       DiagnosisOptions diagnosis = {});

}  // namespace ballbar
