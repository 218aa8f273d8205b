// What data could show, before any residual.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "ballbar/diagnosis/signatures/identifiability.hpp"
#include "model/model_options.hpp"

namespace ballbar {

// A table of all effects, of each target of the model. Throws Error where the data cannot be fitted.
void show_preflight(const ModelOptions& options, const Model& model, const ModelData& data, bool json, bool details);

// Why effects could not be tested, what several have in common once: each reason with their names, in the order of the
// detectabilities.
std::vector<std::pair<std::string, std::vector<std::string>>> by_reason(const std::vector<Detectability>& untestable);

}  // namespace ballbar
