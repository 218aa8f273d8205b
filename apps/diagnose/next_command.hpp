// What to type next, once a diagnosis is there.
#pragma once

#include <string>

#include "ballbar/diagnosis/verdict/diagnosis.hpp"
#include "model/model_options.hpp"

namespace ballbar {

// "ballbar add 'expansion:temperature=T_room_degC' run.csv --model model.toml --target y_um": all that is named, or
// what is probable; else the first that is in question, to `try`. Files as they were typed, quoted where a shell needs
// it. Empty where there is nothing to add, or no model file to add it to.
std::string next_command(const ModelOptions& options, const Diagnosis& found);

// What the user has to do by hand: a value that the model holds, or a model file that is not there. Whole sentences.
std::string next_hint(const ModelOptions& options, const Diagnosis& found);

// As one word of a shell: in single quotes where it holds anything else than letters, digits and _-./=:,+@%.
std::string shell_word(const std::string& text);

}  // namespace ballbar
