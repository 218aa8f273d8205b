// `ballbar predict DATA --model M`: the model's series, with each effect's contribution.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "ballbar/error.hpp"
#include "ballbar/fit/held_model.hpp"
#include "ballbar/formats/series/series_csv.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "ballbar/number_text.hpp"
#include "ballbar/series/runs.hpp"
#include "commands.hpp"
#include "model/model_options.hpp"
#include "predict/predict_batch.hpp"
#include "predict/predict_effects.hpp"
#include "predict/predict_result.hpp"
#include "terminal/caller.hpp"
#include "terminal/command_line.hpp"
#include "terminal/option_checks.hpp"
#include "terminal/output_guard.hpp"
#include "terminal/stderr_line.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar::commands {
namespace {

struct PredictArguments {
  ModelOptions model;
  std::vector<Source> on;
  std::vector<std::string> out;
  std::string state;
  bool anyway = false;
  bool json = false;
};

std::vector<Column> columns_of(const Model& model, const std::string& target, const Prediction& prediction,
                               const Series& data) {
  const std::string stem = stem_of(target);
  std::vector<Column> columns;
  columns.push_back({stem + "_model_um", Role::measured, prediction.predicted_um});
  if (const Column* measured = find_column(data, target)) {
    Column residual{stem + "_residual_um", Role::measured, measured->values};
    for (std::size_t row = 0; row < residual.values.size(); ++row) residual.values[row] -= prediction.predicted_um[row];
    columns.push_back(*measured);
    columns.push_back(std::move(residual));
  }
  for (std::size_t t = 0; t < model.terms.size(); ++t) {
    columns.push_back({fmt::format("{}_{}_{}_um", stem, t + 1, model.terms[t].effect->name), Role::measured,
                       prediction.contribution_um[t]});
  }
  return columns;
}

// Root mean square of what is finite; NaN where nothing is.
double rms(const std::vector<double>& values) {
  double norm = 0.0;
  std::size_t n = 0;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    norm = std::hypot(norm, value);  // whose square may be too large for a double
    ++n;
  }
  return n > 0 ? norm / std::sqrt(static_cast<double>(n)) : std::numeric_limits<double>::quiet_NaN();
}

Table summary(const std::vector<Column>& columns) {
  Table table({"column", "least um", "largest um", "at the end um", "rms um"});
  for (const Column& column : columns) {
    double low = std::numeric_limits<double>::infinity(), high = -low, last = 0.0;
    for (const double value : column.values) {
      if (!std::isfinite(value)) continue;
      low = std::min(low, value);
      high = std::max(high, value);
      last = value;
    }
    if (low > high) continue;
    table.add({one_line(column.name), fixed(low, 3), fixed(high, 3), fixed(last, 3), fixed(rms(column.values), 3)});
  }
  return table;
}

void expect_one_file(const PredictArguments& options) {
  if (options.model.data.size() == 1) return;
  throw Error(fmt::format("expected one file of DATA for {}, found {}.", options.model.model.name(),
                          options.model.data.size()));
}

// A regression over batches has its own parameters, and is fitted to nothing here.
void run_batch_model(const PredictArguments& options) {
  expect_one_file(options);
  if (!options.on.empty()) throw Error("--on: expected a model of effects with it; a regression predicts DATA itself.");
  if (!options.model.target.empty() || options.model.max_gap_s || options.model.robust || options.model.white) {
    throw Error(
        fmt::format("{}: expected neither --target, --max-gap, --robust nor --white: a regression has its target "
                    "and is fitted to nothing here.",
                    options.model.model.name()));
  }
  expect_no_input(options.out, paths_of({options.model.data.front(), options.model.model}));
  predict_batch({options.model.data.front(), options.model.model, options.out, options.anyway, options.json});
}

// It has its own parameters too, and its own start and end.
void run_effects(const PredictArguments& options) {
  expect_one_file(options);
  if (!options.on.empty() || !options.model.target.empty() || options.model.robust || options.model.white ||
      options.anyway) {
    throw Error(
        fmt::format("{}: expected neither --on, --target, --robust, --white nor --anyway: a regression has its "
                    "target, predicts DATA itself and is fitted to nothing here.",
                    options.model.model.name()));
  }
  expect_no_input(options.out, paths_of({options.model.data.front(), options.model.model}));
  predict_effects({options.model.data.front(), options.model.model, options.state, options.out, options.model.max_gap_s,
                   options.json});
}

void run(const PredictArguments& options) {
  if (is_effect_regression(options.model.model)) return run_effects(options);
  if (!options.state.empty()) throw Error("--state: expected a model of train --effects with it.");
  if (is_batch_model(options.model.model)) return run_batch_model(options);
  if (options.anyway) throw Error("--anyway: expected a model of train with it, a model of effects was given.");
  const ModelData data = open_data(options.model);
  const Model model = open_model(options.model, data);
  ModelOptions elsewhere = options.model;
  if (!options.on.empty()) elsewhere.data = options.on;
  const ModelData other = options.on.empty() ? data : open_data(elsewhere);
  std::vector<std::filesystem::path> inputs = data.files;
  inputs.insert(inputs.end(), other.files.begin(), other.files.end());
  if (options.model.model.is_path()) inputs.push_back(options.model.model.path());
  expect_no_input(options.out, inputs);
  Series series;
  series.time_s = one_after_another(other.series->time_s);
  for (std::size_t target = 0; target < model.targets.size(); ++target) {
    const std::vector<FittedParameter> parameters =
        has_free(model) ? fit_of(options.model, model, data, target).parameters : held_parameters(model);
    const Prediction prediction =
        with_source(elsewhere.data.front().name(), [&] { return predict(model, parameters, *other.series); });
    const std::vector<Column> columns = columns_of(model, model.targets[target], prediction, *other.series);
    series.columns.insert(series.columns.end(), columns.begin(), columns.end());
  }
  for (const std::string& path : options.out) write_bytes(path, write_series(series));
  if (options.json) {
    print_json(json_of(PredictedSeries{series}), -1);
  } else {
    fmt::print("{}\n{}: {} rows over {}{}\n\n{}", other.title, options.model.model.name(), series.time_s.size(),
               duration_text(series.time_s.back() - series.time_s.front()),
               options.on.empty() ? "" : fmt::format("\nfitted to {}", data.title),
               summary(series.columns).text(table_width()));
  }
  for (const std::string& path : options.out) wrote_line(path);
  if (other.series->runs.size() > 1 && !options.out.empty()) {
    stderr_line("times go on from run to run, one right after another");
  }
}

}  // namespace

void add_predict(CLI::App& app) {
  const auto options = std::make_shared<PredictArguments>();
  CLI::App* command = app.add_subcommand("predict", "The model's series, with what each effect adds");
  add_model_options(*command, options->model, true);
  add_fit_options(*command, options->model);
  add_sources(*command, "--on", options->on,
              "other data to predict, with the parameters fitted to DATA; may be repeated")
      ->type_name("DATA")
      ->allow_extra_args(false);
  command->add_option("--out", options->out, "write the series, .csv; may be repeated")
      ->type_name("FILE")
      ->allow_extra_args(false)
      ->check(name_that_ends_in({".csv"}));
  command
      ->add_option("--state", options->state,
                   "model of train --effects: goes on from this file, and keeps in it where the last row stood")
      ->type_name("FILE");
  command->add_flag("--anyway", options->anyway, "model of `train`: predict though a sensor looks broken");
  command->add_flag("--json", options->json, "the result for a program");
  command->footer(
      "Example:\n"
      "  ballbar predict sample-runs/two-arcs-he2015 --model sample-runs/two-arcs-he2015/model.toml --out y.csv");
  command->callback([options] { run(*options); });
}

}  // namespace ballbar::commands
