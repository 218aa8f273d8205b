// What the commands about models share: DATA, the model file, and how they are read.
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
  std::vector<TimeRange> left_out;  // readings that are not explained
  StatedCircle circle;
  bool robust = false;
  bool white = false;
  Catalogue catalogue = built_in_catalogue();  // of effects that models may have, and that are searched
};

void add_model_options(CLI::App& command, ModelOptions& options, bool model_required);

// --max-gap
void add_max_gap(CLI::App& command, std::optional<double>& max_gap_s);

// --also-input, for the commands that look for effects.
void add_also_input(CLI::App& command, ModelOptions& options);

// --robust, --white and --set, for the commands that print the fit.
void add_fit_options(CLI::App& command, ModelOptions& options);

constexpr double kUsualGap_s = 600.0;

ModelData open_data(const ModelOptions& options);

// Throws Error where the rows of the data are numbered; `what` needs a clock: "to plan from".
void expect_clock(const ModelData& data, std::string_view what);

// A series or a session of drift. Throws Error for recordings.
ModelData open_drift(const Source& data, const std::optional<double>& max_gap_s);

// The model of the file, its targets replaced where the command line says so; without a file a constant (or, on
// recordings, a circle each). Throws Error: a model of drift for recordings or the other way round, one that does not
// suit the data (expect_suits) with the file's name, a target that is not in um. Targets that --target leaves out are
// no inputs (Model::not_inputs) but where --also-input says so.
Model open_model(const ModelOptions& options, const ModelData& data);

// What every model has before any effect, in words.
std::string_view start_of(Level level);

// Says on the standard error what a model without a file is: a constant, or the circles of recordings.
void say_start(const ModelOptions& options, const ModelData& data);

// Throws Error where an effect of that label would read one of Model::not_inputs.
void expect_no_target(const std::string& label, const std::vector<std::string>& columns, const Model& model);

// The model of one of its targets: the others are no inputs but where --also-input says so. Several targets are looked
// at one by one, each by its own model.
Model of_one_target(const Model& model, const ModelOptions& options, std::size_t target);

// Throws Error, with the model's file, where nothing of it is free.
void expect_to_fit(const ModelOptions& options, const Model& model, const ModelData& data);

// --robust and --white, for fit().
FitOptions fit_options(const ModelOptions& options);

// fit() as the options say. Throws Error with the file that is at fault: the model's (expect_to_fit), or DATA's.
Fit fit_of(const ModelOptions& options, const Model& model, const ModelData& data, std::size_t target);

// What `work` returns; what it throws gets the source in front, "model.toml: ...", where there is one.
template <class Work>
auto with_source(const std::string& source, Work work) -> decltype(work()) {
  if (source.empty()) return work();
  try {
    return work();
  } catch (const Error& error) {
    throw Error(source + ": " + error.what());
  }
}

// "12.3 ± 0.4", "held", "not determined" with as many digits as sigma deserves.
std::string value_text(const FittedParameter& parameter);

}  // namespace ballbar
