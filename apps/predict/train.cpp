// `ballbar train RUNS --target COLUMN --out model.json`: a regression of thermal error on temperatures over batches;
// with --for DATA weighted by their likeness to the job at hand, with --effects on the catalogue's effects.
#include "predict/train.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "ballbar/error.hpp"
#include "ballbar/fit/fit.hpp"
#include "ballbar/formats/models/batch_model_json.hpp"
#include "ballbar/formats/models/model_toml.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "commands.hpp"
#include "model/model_options.hpp"
#include "predict/predict_results.hpp"
#include "terminal/caller.hpp"
#include "terminal/command_line.hpp"
#include "terminal/log_options.hpp"
#include "terminal/option_checks.hpp"
#include "terminal/stderr_line.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar {

Contender contender_of(const OpenedBatches& opened, const RegressionSettings& settings) {
  const Eigen::VectorXd each = held_out_um(opened.batches, std::span(&settings, 1)).col(0);
  const HeldOutErrors errors = held_out_errors({each.data(), static_cast<std::size_t>(each.size())});
  const Moments all = merged(opened.batches);
  return {label_of(settings),
          settings,
          errors,
          opened.batches[errors.worst].name,
          rmse_um(all, regress(all, settings)),
          false};
}

ScreenPart remarks_part(const std::vector<std::string>& remarks) {
  ScreenPart part{"", "the remarks on the data"};
  for (const std::string& remark : remarks) part.text += wrapped(remark);
  return part;
}

std::string contest_text(const std::vector<Contender>& contenders) {
  Table table({"method", "left out um", "worst um", "worst batch", "trained um"});
  for (const Contender& one : contenders) {
    const bool known = !one.worst.empty();
    table.add({one.label + (one.taken ? " *" : ""), fixed(one.held_out.rms_um, 2),
               known ? fixed(one.held_out.worst_um, 2) : "-", known ? one.worst : "-", fixed(one.rmse_um, 2)});
  }
  return table.text(table_width()) +
         wrapped(
             "*: the chosen method. left out: RMSE when each batch is predicted by all the others. The settings are "
             "chosen to minimise it, so it is slightly too small.");
}

namespace commands {
namespace {

void expect_fitting(const TrainOptions& options) {
  const auto is = [&](RegressionMethod method) { return !options.method || *options.method == method; };
  if (options.components && !is(RegressionMethod::pcr)) {
    throw CLI::ValidationError("--components: expected --method pcr.");
  }
  if (options.share && !is(RegressionMethod::pcr)) throw CLI::ValidationError("--share: expected --method pcr.");
  if (options.components && options.share) throw CLI::ValidationError("expected --components or --share, found both.");
  if (options.penalty_K2 && !is(RegressionMethod::ridge)) {
    throw CLI::ValidationError("--penalty: expected --method ridge.");
  }
}

// What is said of one method asks for it.
std::optional<RegressionMethod> method_of(const TrainOptions& options) {
  if (options.method) return options.method;
  if (options.components || options.share) return RegressionMethod::pcr;
  if (options.penalty_K2) return RegressionMethod::ridge;
  return std::nullopt;
}

// As the command line says, by batches left out where it does not.
RegressionSettings chosen_settings(const TrainOptions& options, RegressionMethod method, const OpenedBatches& opened) {
  if (method == method_of(options)) {
    if (options.components) return {method, *options.components, 0.0};
    if (options.share) return {method, components_for(merged(opened.batches), *options.share), 0.0};
    if (options.penalty_K2) return {method, 0, *options.penalty_K2};
  }
  return best_settings(opened.batches, method);
}

// The physical model in the same contest: fitted to all batches but one, the one predicted.
Contender physical(const TrainOptions& options, const OpenedBatches& opened) {
  const ProgressLine progress;
  Model model = read_model(read_bytes(options.model, kLargestText), options.model);
  model.targets = {opened.columns.target};
  const std::size_t count = opened.batches.size();
  std::vector<Series> batches;
  for (std::size_t k = 0; k < count; ++k)
    batches.push_back(read_batch(options.batch(opened.files[k]), options.max_gap_s));
  FitOptions how;
  how.white = true;
  how.starts = 1;
  const HeldOutErrors errors = with_source(options.model, [&] {
    return held_out_errors(model, batches, how, [&](std::size_t k) {
      show_progress(fmt::format("fitting {} without batch {} of {}", options.model, k + 1, count));
    });
  });
  return {options.model,
          {},
          errors,
          opened.batches[errors.worst].name,
          fit(model, joined_batches(batches, model), 0, how).rmse_um,
          false};
}

std::size_t rows_in(const std::vector<Batch>& batches) {
  std::size_t rows = 0;
  for (const Batch& batch : batches) rows += batch.rows;
  return rows;
}

void expect_rows(std::size_t rows, const RegressionSettings& settings) {
  if (rows > settings.components) return;
  throw Error(
      fmt::format("expected more rows than components, found {} rows and {} components.", rows, settings.components));
}

void print_text(const TrainOptions& options, const OpenedBatches& opened, const std::vector<Contender>& contenders,
                const TemperatureRegression& model) {
  const InputKind kind = model.columns.kind;
  const std::string heading = fmt::format("{}\n{} from {} temperatures ({}), {} batches, {} rows\n", options.title(),
                                          model.columns.target, model.columns.sensors.size(),
                                          kind == InputKind::temperature ? "values"
                                          : kind == InputKind::rise      ? "rises since the start of each batch"
                                                                    : "values, and rises since the start of each batch",
                                          opened.batches.size(), rows_in(opened.batches));
  const std::string conclusion = wrapped(fmt::format(
      "The error on new batches is {:.2f} um RMSE with {}, {:.2f} um without a model. "
      "95 % of the errors are within "
      "±{:.2f} um, if they are normally distributed.",
      model.held_out_rmse_um, label_of(model.settings), rms_without_model_um(opened.batches), model.half_width_um));
  fmt::print("{}", on_a_screen({{heading}, {conclusion}, {contest_text(contenders)}, remarks_part(opened.remarks)},
                               options.details));
}

void train_temperatures(const TrainOptions& options) {
  expect_fitting(options);
  const OpenedBatches opened = open_batches(options);
  std::vector<std::filesystem::path> inputs = opened.files;
  if (!options.model.empty()) inputs.emplace_back(options.model);
  expect_no_input({options.out}, inputs);
  std::vector<Contender> contenders;
  for (const RegressionMethod method : kRegressionMethods) {
    const RegressionSettings settings = chosen_settings(options, method, opened);
    expect_rows(rows_in(opened.batches), settings);
    contenders.push_back(with_source(options.title(), [&] { return contender_of(opened, settings); }));
  }
  const auto of_method = [&](const Contender& one) { return one.settings.method == method_of(options); };
  const auto less = [](const Contender& a, const Contender& b) { return a.held_out.rms_um < b.held_out.rms_um; };
  auto best = std::find_if(contenders.begin(), contenders.end(), of_method);
  if (best == contenders.end()) best = std::min_element(contenders.begin(), contenders.end(), less);
  best->taken = true;
  const RegressionSettings settings = best->settings;
  std::optional<ComparedModel> effects;
  if (!options.model.empty()) effects = ComparedModel{physical(options, opened)};
  const TemperatureRegression model = temperature_regression(
      opened.batches, {}, opened.columns, settings,
      [&](std::size_t k) { return read_batch(options.batch(opened.files[k]), options.max_gap_s); });
  write_bytes(options.out, write_batch_model(model));
  if (options.json) {
    print_json(json_of(TrainedOnTemperatures{model.columns.target,
                                             opened.batches.size(),
                                             model.held_out_rmse_um,
                                             model.half_width_um,
                                             contenders,
                                             {effects},
                                             opened.remarks}));
  } else {
    if (effects) contenders.push_back(effects->contender);
    print_text(options, opened, contenders, model);
  }
  wrote_line(options.out);
}

// What an option needs, and what it does not go with.
void expect_together(const TrainOptions& given) {
  const bool lists = lists_batches(given.data);
  if ((given.effects || !lists) && method_of(given)) {
    throw CLI::ValidationError(given.effects
                                   ? "--effects: cannot be combined with --method, --components, --share or --penalty."
                                   : "--method, --components, --share, --penalty: expected a list of runs");
  }
  if (given.few && !given.model.empty()) throw CLI::ValidationError("--few: cannot be combined with --model.");
  if (given.few && !given.start.empty()) throw CLI::ValidationError("--few: cannot be combined with --start-from.");
  if (given.sensors && (given.few || !given.model.empty() || !given.start.empty()))
    throw CLI::ValidationError("--sensors: cannot be combined with --few, --model or --start-from.");
  if (given.effects || !lists) return;
  if (given.sensors) throw CLI::ValidationError("--sensors: expected --effects.");
  if (given.few) throw CLI::ValidationError("--few: expected --effects.");
  if (!given.start.empty()) throw CLI::ValidationError("--start-from: expected --effects.");
}

void expect_together_for_job(const TrainOptions& given) {
  const char* const other = given.effects          ? "--effects"
                            : given.few            ? "--few"
                            : given.sensors        ? "--sensors"
                            : given.components     ? "--components"
                            : given.share          ? "--share"
                            : given.penalty_K2     ? "--penalty"
                            : !given.start.empty() ? "--start-from"
                            : given.model.empty()  ? nullptr
                                                   : "--model";
  if (other != nullptr) throw CLI::ValidationError(fmt::format("{}: cannot be combined with --for", other));
}

void run(const TrainOptions& given) {
  if (!given.job.empty()) {
    expect_together_for_job(given);
    return train_for_job(given);
  }
  expect_together(given);
  const bool on_effects = given.effects || !lists_batches(given.data);
  if (!on_effects && given.out.empty()) throw CLI::RequiredError("--out");
  on_effects ? train_effects(given) : train_temperatures(given);
}

void add_batch_options(CLI::App& command, TrainOptions& options) {
  add_data(command, "RUNS", options.data,
           "list of recorded batches, runs.csv; or logs, a folder of logs or a workbook, for a regression on effects")
      ->required()
      ->type_name("");
  command.add_option("--target", options.target, "column to predict; default: the only measured column")
      ->type_name("COLUMN");
  command.add_option("--room", options.room, "column of the room temperature; default: by its name")
      ->type_name("COLUMN");
  add_choice(command, "--inputs", {"temperature", "rise", "both"}, "temperature",
             "use the temperatures, their rise since the start of the batch, or both",
             [&](std::size_t at) { options.inputs = static_cast<InputKind>(at); });
  command.add_option("--without", options.without, "omit this batch")->type_name("BATCH")->allow_extra_args(false);
  command.add_option("--without-sensor", options.without_sensor, "omit this temperature")
      ->type_name("COLUMN")
      ->allow_extra_args(false);
  command.add_flag("--keep-broken", options.keep_broken, "use sensors even if they seem broken");
}

void add_method_options(CLI::App& command, TrainOptions& options) {
  constexpr const char* kGroup = "Regression on temperatures";
  add_choice(command, "--method", {"pcr", "ridge"}, "the best for batches left out",
             "principal components or ridge regression",
             [&](std::size_t at) { options.method = kRegressionMethods[at]; });
  command.get_option("--method")->group(kGroup);
  command
      .add_option("--components", options.components,
                  "number of components of pcr; default: the best for batches left out")
      ->check(whole_number_within(1, 10000))
      ->type_name("N")
      ->group(kGroup);
  command.add_option("--share", options.share, "pcr: share of the inputs that the components explain, such as 0.99")
      ->check(number_within(0.0, 1.0))
      ->type_name("SHARE")
      ->group(kGroup);
  command
      .add_option("--penalty", options.penalty_K2,
                  "penalty of ridge, K^2 per row; default: the best for batches left out")
      ->check(number_within(0.0, 1e9))
      ->type_name("K2")
      ->group(kGroup);
  command
      .add_option("--model", options.model,
                  "model of effects (.toml): compare it with the regression; with --effects add its effects")
      ->type_name("FILE");
  command.add_flag(
      "--effects", options.effects,
      "use a regression on the catalogue's effects, which can run live; RUNS may be one series or session");
  command.add_flag("--few", options.few, "with --effects: use about ten effects, averaged over nine selections");
  command.add_option("--start-from", options.start, "with --effects: adapt a model .json trained on other machines")
      ->type_name("FILE");
  command
      .add_option("--sensors", options.sensors,
                  "with --effects: choose this many temperatures and show the gain of each")
      ->check(whole_number_within(1, 10000))
      ->type_name("N");
  add_max_gap(command, options.max_gap_s);
}

}  // namespace

void add_train(CLI::App& app) {
  const auto options = std::make_shared<TrainOptions>();
  CLI::App* command = app.add_subcommand("train", "Train a regression of thermal error on temperatures");
  add_batch_options(*command, *options);
  add_method_options(*command, *options);
  add_data(*command, "--for", options->job,
           "series of the current job: train on the batches most like it, and check if it holds the target")
      ->type_name("DATA");
  command->add_option("--out", options->out, "write the model to FILE (.json); optional with --for or --effects")
      ->type_name("FILE")
      ->check(name_that_ends_in({".json"}));
  add_details(*command, options->details);
  command->add_flag("--list-all", options->details)->group("");  // the name of --details before
  command->add_flag("--json", options->json, "print the result as JSON");
  command->footer(
      "Examples:\n"
      "  ballbar train sample-runs/batches-tan2024/runs.csv --target y_um --out model.json\n"
      "  ballbar train sample-runs/spindle-46h/measured.csv --effects --target ch1_um --out ch1.json\n"
      "  ballbar train sample-runs/spindle-46h/measured.csv --sensors 4 --target ch1_um\n"
      "  ballbar train sample-runs/batches-tan2024/runs.csv --target y_um --for sample-runs/batches-tan2024/test1.csv");
  command->callback([options] { run(*options); });
}

}  // namespace commands
}  // namespace ballbar
