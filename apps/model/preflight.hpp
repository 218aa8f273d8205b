// Which effects the data could show, before any residual is examined.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "ballbar/diagnosis/signatures/identifiability.hpp"
#include "model/model_options.hpp"

namespace ballbar {

// A table of all effects for each target of the model. Throws Error if the data cannot be fitted.
void show_preflight(const ModelOptions& options, const Model& model, const ModelData& data, bool json, bool details);

// Why effects of these kinds are not testable: each reason once with the names of its effects, in their order.
std::vector<std::pair<std::string, std::vector<std::string>>> by_reason(const std::vector<Detectability>& all,
                                                                        bool (*is_meant)(Testability));

}  // namespace ballbar
