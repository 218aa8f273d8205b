// Common options of the commands about models: DATA, the model file, and how to read them.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/error.hpp"
#include "ballbar/fit/fit.hpp"
#include "ballbar/formats/recordings/recording_file.hpp"
#include "ballbar/formats/sessions/data_file.hpp"
#include "ballbar/model/model.hpp"
#include "model/left_out_times.hpp"

namespace CLI {
class App;
}

namespace ballbar {

struct ModelOptions {
  std::vector<Source> data;
  Source model;                         // empty: none
  std::vector<std::string> target;      // instead of the model's own
  std::vector<std::string> also_input;  // targets that effects may read
  std::vector<std::string> set;         // parameters held: with_held_values()
  std::optional<double> max_gap_s;
  std::vector<TimeRange> left_out;  // readings to ignore
  StatedCircle circle;
  bool robust = false;
  bool white = false;
  bool says_sensor_jumps = false;  // the result says them: no remark
  bool carries_unit = false;       // results are given in the unit of the target: no remark that um stands for it
  Catalogue catalogue = built_in_catalogue();  // effects for models and searches
};

void add_model_options(CLI::App& command, ModelOptions& options, bool model_required);

// --max-gap
void add_max_gap(CLI::App& command, std::optional<double>& max_gap_s);

// --also-input, for the commands that search for effects; its columns of the data.
void add_also_input(CLI::App& command, ModelOptions& options);
std::vector<std::string> also_inputs(const ModelOptions& options, const Series& data);

// --robust, --white and --set, for the commands that print the fit.
void add_fit_options(CLI::App& command, ModelOptions& options);

ModelData open_data(const ModelOptions& options);

// Throws Error for data without a clock; `what`: why a clock is needed, "to plan from".
void expect_clock(const ModelData& data, std::string_view what);

// A series or a session of drift. Throws Error for recordings.
ModelData open_drift(const Source& data, const std::optional<double>& max_gap_s);

// The model of the file, with the targets of the command line if given. Without a file a constant, or on recordings one
// circle each. Throws Error: a model of drift for recordings or vice versa, a model that does not suit the data
// (expect_suits) with the name of the file, a target that is not in um. Targets that --target leaves out are not inputs
// (Model::not_inputs), except with --also-input.
Model open_model(const ModelOptions& options, const ModelData& data);

// In words: the part that every model has without effects.
std::string_view start_of(Level level);

// Prints on the standard error that a model without a file is a constant, or the circles of recordings.
void say_start(const ModelOptions& options, const ModelData& data);

// Throws Error if an effect with this label would read one of Model::not_inputs.
void expect_no_target(const std::string& label, const std::vector<std::string>& columns, const Model& model);

// The model for one of its targets. The others are not inputs, except with --also-input. Several targets are processed
// one by one, each with its own model.
Model of_one_target(const Model& model, const ModelOptions& options, const Series& data, std::size_t target);

// Throws Error, with the model's file, if no parameter is free.
void expect_to_fit(const ModelOptions& options, const Model& model, const ModelData& data);

// --robust and --white, for fit().
FitOptions fit_options(const ModelOptions& options);

// fit() with the options. Throws Error with the faulty file: that of the model (expect_to_fit) or DATA.
Fit fit_of(const ModelOptions& options, const Model& model, const ModelData& data, std::size_t target);

// Returns the result of `work`; prefixes its errors with the source, "model.toml: ...", if there is one.
template <class Work>
auto with_source(const std::string& source, Work work) -> decltype(work()) {
  if (source.empty()) return work();
  try {
    return work();
  } catch (const Error& error) {
    throw Error(source + ": " + error.what());
  }
}

// "12.3 ± 0.4", "held", "not determined"; the number of digits follows from sigma.
std::string value_text(const FittedParameter& parameter);

}  // namespace ballbar
