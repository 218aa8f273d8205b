// `ballbar predict DATA --model M`: the model's series, with each effect's contribution.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "ballbar/error.hpp"
#include "ballbar/formats/models/batch_model_json.hpp"
#include "ballbar/formats/models/effect_regression_json.hpp"
#include "ballbar/formats/series/series_csv.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "ballbar/formats/text/reader.hpp"
#include "ballbar/internal/fit/held_model.hpp"
#include "ballbar/internal/number_text.hpp"
#include "ballbar/series/series.hpp"
#include "commands.hpp"
#include "model/model_options.hpp"
#include "model/other_data.hpp"
#include "predict/predict_results.hpp"
#include "predict/predicted_job.hpp"
#include "terminal/caller.hpp"
#include "terminal/command_line.hpp"
#include "terminal/log_options.hpp"
#include "terminal/option_checks.hpp"
#include "terminal/stderr_line.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar::commands {
namespace {

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
  Table table({"column", "minimum um", "maximum um", "end um", "RMS um"});
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

// A regression has its own parameters, and is fitted to nothing here: on effects its own start and end, too.
void run_regression(const PredictOptions& options, bool of_effects) {
  const ModelOptions& model = options.model;
  if (model.data.size() != 1) {
    throw Error(fmt::format("expected one file of DATA for {}, found {}.", model.model.name(), model.data.size()));
  }
  if (!of_effects && !options.on.empty()) {
    throw Error("--on: expected a model of effects, found a regression, which predicts DATA itself.");
  }
  const bool fits = !model.target.empty() || model.robust || model.white;
  if (of_effects && (fits || !options.on.empty() || options.anyway)) {
    throw Error(
        fmt::format("{}: expected neither --on, --target, --robust, --white nor --anyway. A regression has its "
                    "target and predicts DATA without a fit.",
                    model.model.name()));
  }
  if (!of_effects && fits) {
    throw Error(
        fmt::format("{}: expected neither --target, --robust nor --white. A regression has its target "
                    "and predicts without a fit.",
                    model.model.name()));
  }
  expect_no_input(options.out, paths_of({model.data.front(), model.model}));
  of_effects ? predict_by_effects(options) : predict_by_temperatures(options);
}

void run(const PredictOptions& options) {
  const std::string head = options.model.model.head(kHeadBytes);
  if (is_effect_regression_json(head)) return run_regression(options, true);
  if (!options.state.empty()) throw Error("--state: expected a model of train --effects.");
  if (is_batch_model_json(head)) return run_regression(options, false);
  if (options.anyway) throw Error("--anyway: expected a model of train, found a model of effects.");
  const ModelData data = open_data(options.model);
  const Model model = open_model(options.model, data);
  ModelOptions elsewhere = options.model;
  if (!options.on.empty()) elsewhere.data = options.on;
  const OtherData place =
      options.on.empty() ? of_its_own(data) : open_other(elsewhere, model, data, options.model.data);
  const ModelData& other = place.data;
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
        with_source(elsewhere.data.front().name(), [&] { return predict(model, parameters, place); });
    const std::vector<Column> columns = columns_of(model, model.targets[target], prediction, *other.series);
    series.columns.insert(series.columns.end(), columns.begin(), columns.end());
  }
  for (const std::string& path : options.out) write_bytes(path, write_series(series));
  if (options.json) {
    print_json(json_of(series), -1);
  } else {
    fmt::print("{}\n{}: {} rows over {}{}\n\n{}", other.title, options.model.model.name(), series.time_s.size(),
               duration_text(series.time_s.back() - series.time_s.front()),
               options.on.empty() ? "" : fmt::format("\nfitted to {}", data.title),
               summary(series.columns).text(table_width()));
  }
  for (const std::string& path : options.out) wrote_line(path);
  if (other.series->runs.size() > 1 && !options.out.empty()) {
    stderr_line("the times of the runs follow each other without gaps");
  }
}

}  // namespace

void add_predict(CLI::App& app) {
  const auto options = std::make_shared<PredictOptions>();
  CLI::App* command = app.add_subcommand("predict", "Predict a series with a model, effect by effect");
  add_model_options(*command, options->model, true);
  add_fit_options(*command, options->model);
  add_data(*command, "--on", options->on, "predict other data with the parameters fitted to DATA; may be repeated")
      ->type_name("DATA")
      ->allow_extra_args(false);
  command->add_option("--out", options->out, "write the series to FILE (.csv); may be repeated")
      ->type_name("FILE")
      ->allow_extra_args(false)
      ->check(name_that_ends_in({".csv"}));
  command
      ->add_option("--state", options->state,
                   "model of train --effects: continue from this file and save the state of the last row in it")
      ->type_name("FILE");
  command->add_flag("--anyway", options->anyway, "model of `train`: predict even if a sensor seems broken");
  command->add_flag("--json", options->json, "print the result as JSON");
  command->footer(
      "Example:\n"
      "  ballbar predict sample-runs/two-arcs-he2015 --model sample-runs/two-arcs-he2015/model.toml --out y.csv");
  command->callback([options] { run(*options); });
}

}  // namespace ballbar::commands
