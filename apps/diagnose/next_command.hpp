// The next command after a diagnosis.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/diagnosis/verdict/diagnose.hpp"
#include "ballbar/message.hpp"
#include "ballbar/revision/revision.hpp"
#include "model/model_options.hpp"

namespace ballbar {

// "ballbar add 'lagged_expansion(T_room_degC, time_constant_s = 3120)' run.csv --model model.toml --target y_um": all
// named or probable effects, else with --dry-run the most probable one from P = 0.5 on. With the moments, periods and
// time constants that were found: the fit starts there. Files as typed, quoted for a shell. Empty: nothing to add, or
// the data have no name.
std::string next_command(const ModelOptions& options, const Diagnosis& found);

// What the next command does, for a program or a page.
enum class Action {
  add,      // effects that are named or probable
  try_out,  // the most probable effect, which is not certain
  free,     // values that the model holds
  plan,     // another test
};
std::string_view name_of(Action action);

struct ParameterStart {
  std::string effect, parameter;
  double start = 0.0;
};

struct NextAction {
  Action action = Action::plan;
  std::vector<std::string> effects;        // as `add` takes them; none is in doubt
  std::vector<std::string> labels;         // of these, as the candidates have them
  std::vector<ParameterStart> parameters;  // to free, from there on
  std::optional<double> promised_rmse_um;  // that the model leaves then; nullopt: not known
};

// Without its RMSE. nullopt: there is nothing to do.
std::optional<NextAction> next_action(const ModelOptions& options, const Diagnosis& found);

// "ballbar add 'step(onset_s = 33840)' run.csv --model model.toml --target y_um --replace 'gradient_bending(T9, T2)'"
std::string replace_command(const ModelOptions& options, const Replacement& replacement);

// Whether P of a candidate is large enough for a command, or for a mark in a table.
bool is_proposed(const Candidate& candidate);

// Whether another run of the machine would tell more.
bool is_for_plan(const Diagnosis& found);

// Columns that measure the same quantity, of which several are in question: no run tells them apart.
std::vector<std::vector<std::string>> equal_columns_in_question(const Diagnosis& found);

// `ballbar plan` for these data; empty: the data have no name.
std::string plan_command(const ModelOptions& options, const Diagnosis& found);

// Whether something is missing that is not completely named.
bool is_left(Verdict verdict);

// "ballbar train run.csv --model model.toml --target y_um --out y.json"; empty: the data have no name.
std::string train_command(const ModelOptions& options, const Diagnosis& found, bool with_model);

// "ballbar add 'expansion(T_room_degC)' run.csv --model model.toml --target y_um": saves the tested effect.
std::string add_command(const ModelOptions& options, const EffectTest& tried);

// The file of the model as typed; without one a new name: model.toml, model-2.toml ...
std::string model_file(const ModelOptions& options);

// Whole sentences: what the user has to do by hand about a wrong held value.
Paragraph next_hint(const ModelOptions& options, const Diagnosis& found);

}  // namespace ballbar
