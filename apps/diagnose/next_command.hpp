// What to type next, once a diagnosis is there.
#pragma once

#include <string>

#include "ballbar/diagnosis/verdict/diagnosis.hpp"
#include "ballbar/revision/effect_test.hpp"
#include "ballbar/revision/replacement.hpp"
#include "model/model_options.hpp"

namespace ballbar {

// "ballbar add 'expansion:temperature=T_room_degC' run.csv --model model.toml --target y_um": all that is named, or
// what is probable; else the first that is in question, with --dry-run. Files as they were typed, quoted where a shell
// needs it. Empty where there is nothing to add, or no way to type it.
std::string next_command(const ModelOptions& options, const Diagnosis& found);

// "ballbar add 'step(onset_s = 33840)' run.csv --model model.toml --target y_um --replace 'gradient_bending(T9, T2)'"
std::string replace_command(const ModelOptions& options, const Replacement& replacement);

// Whether another run of the machine would tell more.
bool is_for_plan(const Diagnosis& found);

// `ballbar plan` of these data; empty where it cannot be typed.
std::string plan_command(const ModelOptions& options, const Diagnosis& found);

// Whether something is missing that is not all named.
bool is_left(Verdict verdict);

// "ballbar train run.csv --model model.toml --target y_um --out y.json"; empty where it cannot be typed.
std::string train_command(const ModelOptions& options, const Diagnosis& found, bool with_model);

// "ballbar add 'expansion(T_room_degC)' run.csv --model model.toml --target y_um": what saves what was tried.
std::string add_command(const ModelOptions& options, const EffectTest& tried);

// "ballbar diagnose run.csv --model model.toml --target y_um"
std::string diagnose_command(const ModelOptions& options, const std::string& target);

// The model's file as it was typed; where none was, a name that no file has yet: model.toml, model-2.toml ...
std::string model_file(const ModelOptions& options);

// What the user has to do by hand: a value that the model holds. Whole sentences.
std::string next_hint(const ModelOptions& options, const Diagnosis& found);

}  // namespace ballbar
