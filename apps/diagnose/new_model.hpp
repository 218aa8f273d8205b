// A model's file that is not there yet.
#pragma once

#include <string>

#include "ballbar/model/model.hpp"
#include "model/model_options.hpp"

namespace ballbar {

// Without a file, or with the name of one that is not there.
bool is_new_model(const ModelOptions& options);

// The options without the name of a file that is not there yet: there is nothing to read.
ModelOptions readable(ModelOptions options);

// Of its file before any effect is added: a line that says what made it, level and targets.
std::string new_model_text(const Model& model);

}  // namespace ballbar
