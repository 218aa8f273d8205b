#include "model/model_options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "ballbar/error.hpp"
#include "ballbar/formats/logs/column_named.hpp"
#include "ballbar/formats/models/model_toml.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "ballbar/formats/text/log_recipe.hpp"
#include "ballbar/formats/text/reader.hpp"
#include "ballbar/internal/model/recording_base_model.hpp"
#include "ballbar/internal/model/run_terms.hpp"
#include "ballbar/internal/nearest_name.hpp"
#include "ballbar/internal/number_text.hpp"
#include "ballbar/model/model.hpp"
#include "model/column_fault_text.hpp"
#include "model/held_values.hpp"
#include "model/resolve_columns.hpp"
#include "model/targets_in_um.hpp"
#include "terminal/command_line.hpp"
#include "terminal/log_options.hpp"
#include "terminal/option_checks.hpp"
#include "terminal/stderr_line.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar {
namespace {

// As expect_suits, with the model's file; a model that is all held still predicts.
void expect_model_suits(Model model, const ModelOptions& options, const ModelData& data) {
  if (model.level == Level::series) model.constant_um.reset();
  const auto expect_targets = [&] { expect_explainable(model.targets, *data.series); };
  if (options.target.empty()) {
    with_source(options.model.empty() ? options.data.front().name() : options.model.name(), expect_targets);
  } else {
    try {
      expect_targets();
    } catch (const Error& error) {
      throw Error(fmt::format("--{}", error.what()));  // --target: expected ...
    }
  }
  if (!options.also_input.empty() && model.targets.size() > 1) return;  // of_one_target: one may read another
  with_source(options.model.name(), [&] { expect_suits(model, *data.series); });
}

// What it throws is of an option: "--target: expected ..."
template <class Work>
auto with_option(std::string_view option, Work work) {
  try {
    return work();
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}", option, error.what()));
  }
}

bool is_in(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

void expect_also_inputs(const ModelOptions& options, const Model& model, const Series& data) {
  for (const std::string& column : also_inputs(options, data)) {
    if (find_column(data, column) == nullptr) {
      std::vector<std::string_view> known;
      for (const Column& one : data.columns) known.emplace_back(one.name);
      throw Error(fmt::format("--also-input: expected a column of the data, found {}; the nearest is {}.",
                              in_quotes(column), nearest_name(column, known)));
    }
    if (model.targets.size() == 1 && model.targets.front() == column) {
      throw Error(fmt::format("--also-input: expected a column other than the target, found {}.", in_quotes(column)));
    }
  }
}

// The columns of a model's file, which may have the names of the log. Those of a formula stand in its text.
void name_columns(Model& model, const Series& data) {
  model.targets = columns_named(data, model.targets);
  for (Term& term : model.terms) {
    if (term.effect->name != "expression") term.columns = columns_named(data, term.columns);
  }
}

// Puts the model's own targets aside where others are chosen.
void choose_targets(Model& model, const ModelOptions& options, const Series& data) {
  if (options.target.empty()) return;
  const std::vector<std::string> targets = with_option("--target", [&] { return columns_named(data, options.target); });
  const std::vector<std::string> also = also_inputs(options, data);
  for (const std::string& target : model.targets) {
    if (!is_in(targets, target) && !is_in(also, target)) model.not_inputs.push_back(target);
  }
  model.targets = targets;
}

// A model's numbers are in um where its target is.
void say_unit(const std::string& target) {
  const std::string_view unit = unit_of(target);
  if (unit == "um") return;
  stderr_line(fmt::format("{} {}: um in the results stands for {}", one_line(target),
                          unit.empty() ? "states no unit" : fmt::format("is in {}", unit),
                          unit.empty() ? "the units of the column" : unit));
}

// Effects of a file that have a time constant need data with a clock.
void expect_clock_of_model(const Model& model, const ModelOptions& options, const ModelData& data) {
  if (options.model.empty()) return;
  for (const Term& term : model.terms) {
    if (needs_clock(*term.effect))
      with_source(options.model.name(), [&] { expect_clock(data, "for " + label_of(term)); });
  }
}

// A table in which two columns lie on a circle is a series all the same, where --target names one of its columns.
std::vector<Source> with_stated_targets(const ModelOptions& options) {
  std::vector<Source> data = options.data;
  if (options.target.empty() || is_in(options.target, "deviation_um")) return data;  // the latter is that of a circle
  for (Source& source : data) {
    if (!source.recipe().columns.empty() || read_of<ReadCircle>(source.reader()) == nullptr) continue;
    auto recipe = std::make_shared<LogRecipe>(source.recipe());
    for (const std::string& target : options.target) recipe->columns.push_back({target, "", "", Role::measured, false});
    source.set_recipe(std::move(recipe));
  }
  return data;
}

}  // namespace

void expect_clock(const ModelData& data, std::string_view what) {
  if (data.series->has_clock) return;
  throw Error(
      fmt::format("{}: expected data with a clock {}, found numbered rows; --every 10s states how far apart they "
                  "are.",
                  data.title, what));
}

void add_max_gap(CLI::App& command, std::optional<double>& max_gap_s) {
  take_time(*command.add_option(
                "--max-gap", max_gap_s,
                "longest gap of a signal to interpolate over; default: 3 usual steps of the signal, at least 10min"),
            true);
}

void add_model_options(CLI::App& command, ModelOptions& options, bool model_required) {
  options.catalogue = catalogue_of(command);
  add_data(command, "DATA", options.data,
           "series .csv, log, session or recordings (.b5r, logs); a folder or workbook of logs is read as runs")
      ->required()
      ->type_name("");
  CLI::Option* model =
      add_source(command, "--model", options.model, "model.toml: the effects to fit")->type_name("FILE");
  if (model_required) model->required();
  command.add_option("--target", options.target, "column to explain instead of the model's own; may be repeated")
      ->type_name("COLUMN")
      ->allow_extra_args(false);
  add_max_gap(command, options.max_gap_s);
  add_left_out_times(command, options.left_out);
  add_radius(command, options.circle);
}

void add_also_input(CLI::App& command, ModelOptions& options) {
  command.add_option("--also-input", options.also_input, "allow effects to read this other target; may be repeated")
      ->type_name("COLUMN")
      ->allow_extra_args(false);
}

void add_fit_options(CLI::App& command, ModelOptions& options) {
  command.add_flag("--robust", options.robust, "discount outlying values (Tukey's biweight)");
  command.add_flag("--white", options.white, "ordinary least squares, without autocorrelated noise");
  command
      .add_option("--set", options.set,
                  "hold a parameter at a value, such as 'lagged_expansion(T9_degC).time_constant_s=3600', and fit the "
                  "others; may be repeated")
      ->type_name("EFFECT.PARAMETER=VALUE")
      ->allow_extra_args(false);
}

ModelData open_data(const ModelOptions& options) {
  ModelData data = with_targets_in_um(
      open_model_data(with_stated_targets(options), {}, options.max_gap_s, known_readers(), options.circle), options);
  tell(data.remarks);
  if (!options.says_sensor_jumps)
    for (const SensorJump& jump : data.series->sensor_jumps) tell({text_of(sentence_of(jump))});
  if (!data.series->has_clock) {
    stderr_line(
        "no clock: the rows are numbered, effects with a time constant are not searched, and a second in the "
        "results is a row; --every 10s states how far apart the rows are");
  }
  return without_times(std::move(data), options.left_out);
}

ModelData open_drift(const Source& data, const std::optional<double>& max_gap_s) {
  ModelOptions how;
  how.data = {data};
  how.max_gap_s = max_gap_s;
  ModelData opened = open_data(how);
  if (opened.level == Level::series) return opened;
  throw Error(fmt::format("{}: expected a series or a session of drift, found recordings.", data.name()));
}

Model open_model(const ModelOptions& options, const ModelData& data) {
  Model model;
  if (options.model.empty()) {
    if (data.level == Level::recording) {
      model = recording_base_model(*data.series, options.catalogue);
      model.targets = data.targets;
    } else {
      model.targets = data.targets;
    }
  } else {
    model = read_model(options.model.bytes(kLargestText), options.model.name(), options.catalogue);
    if (model.level != data.level) {
      throw Error(fmt::format("{}: expected a model of {}, found one of {}.", options.model.name(),
                              data.level == Level::recording ? "recordings (level = \"recording\")" : "a drift series",
                              model.level == Level::recording ? "recordings" : "a drift series"));
    }
    if (data.motion) with_source(options.model.name(), [&] { expect_acts(model, *data.motion); });
    if (model.level == Level::recording) model = with_circles(std::move(model), *data.series);
    if (model.level == Level::series) with_source(options.model.name(), [&] { name_columns(model, *data.series); });
  }
  expect_clock_of_model(model, options, data);
  std::vector<std::string> held = options.set;
  if (data.level == Level::series) {
    for (std::string& one : held) one = with_option("--set", [&] { return with_column_names(one, *data.series); });
  }
  model = with_held_values(with_run_terms(std::move(model), *data.series), held);
  choose_targets(model, options, *data.series);
  if (model.targets.empty())
    throw Error(fmt::format("{}: expected a measured column to explain, found none; --target names one, of {}.",
                            data.title, fmt::join(column_names(*data.series), ", ")));
  expect_model_suits(model, options, data);
  expect_also_inputs(options, model, *data.series);
  for (const std::string& target : model.targets) {
    if (!options.carries_unit) say_unit(target);
  }
  return model;
}

std::string_view start_of(Level level) {
  return level == Level::recording ? "the circle of each recording" : "a constant";
}

void say_start(const ModelOptions& options, const ModelData& data) {
  if (!options.model.empty()) return;
  stderr_line(fmt::format("no --model: the model is {} alone", start_of(data.level)));
}

void expect_no_target(const std::string& label, const std::vector<std::string>& columns, const Model& model) {
  for (const std::string& column : columns) {
    if (!is_in(model.not_inputs, column)) continue;
    throw Error(fmt::format("{}: expected an input that is no target, found {}; --also-input {} takes it for one.",
                            label, in_quotes(column), column));
  }
}

std::vector<std::string> also_inputs(const ModelOptions& options, const Series& data) {
  return with_option("--also-input", [&] { return columns_named(data, options.also_input); });
}

Model of_one_target(const Model& model, const ModelOptions& options, const Series& data, std::size_t target) {
  Model one = model;
  const std::vector<std::string> also = also_inputs(options, data);
  one.targets = {model.targets[target]};
  for (const std::string& other : model.targets) {
    if (other != one.targets.front() && !is_in(also, other)) one.not_inputs.push_back(other);
  }
  return one;
}

void expect_to_fit(const ModelOptions& options, const Model& model, const ModelData& data) {
  with_source(options.model.name(), [&] { expect_suits(model, *data.series); });
}

FitOptions fit_options(const ModelOptions& options) {
  FitOptions how;
  how.robust = options.robust;
  how.white = options.white;
  how.among_all_errors = !options.white && !options.robust;
  return how;
}

Fit fit_of(const ModelOptions& options, const Model& model, const ModelData& data, std::size_t target) {
  expect_to_fit(options, model, data);
  return with_source(options.data.front().name(),
                     [&] { return fit(model, *data.series, target, fit_options(options)); });
}

std::string value_text(const FittedParameter& parameter) {
  if (parameter.state == ParameterState::held) return fmt::format("{:g} held", parameter.value);
  if (parameter.state == ParameterState::undetermined) return "not determined";
  const bool free = parameter.state == ParameterState::free;
  if (!std::isfinite(parameter.sigma)) {
    return fmt::format("{:.4g}{}", parameter.value, free ? ", sigma not known" : " on its bound");
  }
  if (parameter.sigma < 1e-6 * std::abs(parameter.value)) {
    return fmt::format("{:.6g} ± {:.0e}", parameter.value, parameter.sigma);
  }
  const int decimals = parameter.sigma > 0.0 ? decimals_showing(2, parameter.sigma, 9) : 4;
  return with_sigma(parameter.value, parameter.sigma, decimals);
}

}  // namespace ballbar
