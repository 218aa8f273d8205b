// `ballbar train RUNS --target COLUMN --out model.json`: a regression of thermal error on temperatures over batches;
// with --for DATA over those that are like the job at hand.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "ballbar/batches/batch_regression.hpp"
#include "ballbar/batches/held_out_model.hpp"
#include "ballbar/batches/merged_batches.hpp"
#include "ballbar/error.hpp"
#include "ballbar/fit/fit.hpp"
#include "ballbar/formats/models/batch_model_json.hpp"
#include "ballbar/formats/models/model_toml.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "batches/batch_choice.hpp"
#include "batches/batches.hpp"
#include "batches/train_effects.hpp"
#include "batches/train_result.hpp"
#include "commands.hpp"
#include "model/model_options.hpp"
#include "terminal/caller.hpp"
#include "terminal/command_line.hpp"
#include "terminal/option_checks.hpp"
#include "terminal/output_guard.hpp"
#include "terminal/progress.hpp"
#include "terminal/stderr_line.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar::commands {
namespace {

struct TrainArguments {
  BatchOptions batches;
  std::optional<std::size_t> method;
  std::optional<std::size_t> components;
  std::optional<double> share, penalty_K2;
  std::string model;  // of effects, to compare with
  bool effects = false, few = false;
  std::optional<double> max_gap_s;
  std::string out;
  bool json = false;
  ChoiceOptions choice;  // with --for
};

Contender contender(const OpenedBatches& opened, const RegressionSettings& settings) {
  const Eigen::VectorXd each = held_out_um(opened.batches, std::span(&settings, 1)).col(0);
  const HeldOutErrors errors = held_out_errors({each.data(), static_cast<std::size_t>(each.size())});
  const Moments all = merged(opened.batches);
  return {settings, errors.rms_um, errors.worst_um, opened.batches[errors.worst].name,
          rmse_um(all, regress(all, settings))};
}

void expect_fitting(const TrainArguments& options) {
  const auto is = [&](RegressionMethod method) {
    return !options.method || *options.method == static_cast<std::size_t>(method);
  };
  if (options.components && !is(RegressionMethod::pcr) && !is(RegressionMethod::pls)) {
    throw CLI::ValidationError("--components: expected --method pcr or pls with it.");
  }
  if (options.share && !is(RegressionMethod::pcr))
    throw CLI::ValidationError("--share: expected --method pcr with it.");
  if (options.components && options.share) throw CLI::ValidationError("expected --components or --share, found both.");
  if (options.penalty_K2 && !is(RegressionMethod::ridge)) {
    throw CLI::ValidationError("--penalty: expected --method ridge with it.");
  }
}

// As the command line says, by batches left out where it does not.
RegressionSettings chosen_settings(const TrainArguments& options, RegressionMethod method,
                                   const OpenedBatches& opened) {
  const bool asked = options.method == static_cast<std::size_t>(method);
  if (asked && options.components) return {method, *options.components, 0.0};
  if (asked && options.share) return {method, components_for(merged(opened.batches), *options.share), 0.0};
  if (asked && options.penalty_K2) return {method, 0, *options.penalty_K2};
  return choose_by_held_out(opened.batches, method).settings;
}

// The physical model in the same contest: fitted to all batches but one, the one predicted.
Contender physical(const TrainArguments& options, const OpenedBatches& opened) {
  Model model = read_model(read_bytes(options.model, kLargestText), options.model);
  model.targets = {opened.columns.target};
  const std::size_t count = opened.batches.size();
  std::vector<Series> batches;
  for (std::size_t k = 0; k < count; ++k) batches.push_back(read_batch(opened.files[k]));
  FitOptions how;
  how.white = true;
  how.starts = 1;
  const HeldOutErrors errors = with_source(options.model, [&] {
    return held_out_errors(model, batches, how, [&](std::size_t k) {
      show_progress(fmt::format("fitting {} without batch {} of {}", options.model, k + 1, count));
    });
  });
  return {{},
          errors.rms_um,
          errors.worst_um,
          opened.batches[errors.worst].name,
          fit(model, joined_batches(batches, model), 0, how).rmse_um};
}

void expect_rows(const OpenedBatches& opened, const RegressionSettings& settings) {
  std::size_t rows = 0;
  for (const Batch& batch : opened.batches) rows += batch.rows;
  if (rows > settings.components) return;
  throw Error(
      fmt::format("expected more rows than components, found {} rows and {} components.", rows, settings.components));
}

void print_text(const TrainArguments& options, const OpenedBatches& opened, const std::vector<Contender>& contenders,
                const std::optional<Contender>& effects, const BatchModel& model) {
  std::size_t rows = 0;
  for (const Batch& batch : opened.batches) rows += batch.rows;
  fmt::print("{}\n{} from {} ({}), {} batches, {} rows\n\n", options.batches.list.name(), model.columns.target,
             fmt::format("{} temperatures", model.columns.sensors.size()),
             model.columns.kind == InputKind::temperature ? "as they are"
             : model.columns.kind == InputKind::rise      ? "their rise since each batch began"
                                                          : "as they are, and their rise since each batch began",
             opened.batches.size(), rows);
  fmt::print(
      "{}",
      wrapped(fmt::format(
          "A batch that the model has not seen is predicted to {:.2f} um RMSE by {}, of "
          "{:.2f} um without any model. 95 % of its errors are within ±{:.2f} um, if those of each batch are normal.",
          model.held_out_rmse_um, label_of(model.settings), rms_without_model_um(opened.batches),
          model.half_width_um)));
  Table table({"method", "left out um", "worst um", "worst batch", "trained um"});
  for (const Contender& one : contenders) {
    table.add({label_of(one.settings) + (one.settings == model.settings ? " *" : ""), fixed(one.held_out_um, 2),
               fixed(one.worst_um, 2), one.worst, fixed(one.rmse_um, 2)});
  }
  if (effects) {
    table.add({options.model, fixed(effects->held_out_um, 2), fixed(effects->worst_um, 2), effects->worst,
               fixed(effects->rmse_um, 2)});
  }
  fmt::print(
      "\n{}{}", table.text(table_width()),
      wrapped("* is written. left out: RMSE where each batch in turn is predicted by all the others; the settings "
              "are chosen by it, so that it is a little too good."));
  if (!opened.remarks.empty()) fmt::print("\n");
  for (const std::string& remark : opened.remarks) fmt::print("{}", wrapped(remark));
}

// What is said of one method asks for it.
std::optional<std::size_t> method_of(const TrainArguments& options) {
  if (options.method) return options.method;
  if (options.components || options.share) return static_cast<std::size_t>(RegressionMethod::pcr);
  if (options.penalty_K2) return static_cast<std::size_t>(RegressionMethod::ridge);
  return std::nullopt;
}

// A regression on the effects, of a list of runs beside those on temperatures.
void run_effects(const TrainArguments& options) {
  const BatchOptions& batches = options.batches;
  if (method_of(options) || !options.model.empty()) {
    throw CLI::ValidationError(
        "--effects: expected neither --method, --components, --share, --penalty nor --model with it.");
  }
  TrainEffectsOptions how{batches.list,      batches.target, batches.without, batches.without_sensor,
                          options.max_gap_s, false,          options.out,     options.json};
  how.few = options.few;
  if (!is_run_list(batches.list)) {
    if (batches.room || batches.inputs != 0 || !batches.without.empty() || batches.keep_broken) {
      throw Error(fmt::format("{}: expected a list of runs for --room, --inputs, --without and --keep-broken.",
                              batches.list.name()));
    }
    expect_no_input({options.out}, paths_of({batches.list}));
    train_effects(how, {}, {}, {});
    return;
  }
  if (options.max_gap_s) throw Error("--max-gap: expected a session or a series with it, found a list of runs.");
  const OpenedBatches opened = open_batches(batches);
  expect_no_input({options.out}, opened.files);
  std::vector<OtherMethod> others;
  for (const RegressionMethod method :
       {RegressionMethod::pcr, RegressionMethod::ridge, RegressionMethod::pls, RegressionMethod::ols}) {
    const Contender one = with_source(
        batches.list.name(), [&] { return contender(opened, choose_by_held_out(opened.batches, method).settings); });
    others.push_back({label_of(one.settings), one.held_out_um, one.worst_um, one.worst, one.rmse_um});
  }
  const Series first = read_batch(opened.files.front());
  for (const Column& column : first.columns) {
    const std::vector<std::string>& kept = opened.columns.sensors;
    if (is_sensor(column) && std::find(kept.begin(), kept.end(), column.name) == kept.end()) {
      how.without_sensor.push_back(column.name);
    }
  }
  train_effects(how, {opened.files.begin(), opened.files.begin() + static_cast<std::ptrdiff_t>(opened.batches.size())},
                others, opened.remarks);
}

// Of the batches that suit the job.
void run_for(const TrainArguments& given) {
  const char* const other = given.effects         ? "--effects"
                            : given.few           ? "--few"
                            : given.components    ? "--components"
                            : given.penalty_K2    ? "--penalty"
                            : given.max_gap_s     ? "--max-gap"
                            : given.model.empty() ? nullptr
                                                  : "--model";
  if (other != nullptr) throw CLI::ValidationError(fmt::format("{}: expected no --for with it", other));
  if (given.share && given.method.value_or(0) != static_cast<std::size_t>(RegressionMethod::pcr)) {
    throw CLI::ValidationError("--share: expected --method pcr with it");
  }
  ChoiceOptions choice = given.choice;
  choice.batches = given.batches;
  choice.method = given.method;
  choice.selection.share = given.share;
  choice.out = given.out;
  choice.json = given.json;
  choose_batches(std::move(choice));
}

void run(const TrainArguments& given, const std::vector<CLI::Option*>& of_a_choice) {
  if (!given.choice.job.empty()) return run_for(given);
  expect_none_given(of_a_choice, "--for");
  if (given.out.empty()) throw CLI::RequiredError("--out");
  if (given.effects) return run_effects(given);
  if (given.few) throw CLI::ValidationError("--few: expected --effects with it.");
  if (given.max_gap_s) throw CLI::ValidationError("--max-gap: expected --effects with it.");
  expect_fitting(given);
  TrainArguments options = given;
  options.method = method_of(given);
  const OpenedBatches opened = open_batches(options.batches);
  std::vector<std::filesystem::path> inputs = opened.files;
  if (!options.model.empty()) inputs.emplace_back(options.model);
  expect_no_input({options.out}, inputs);
  std::vector<Contender> contenders;
  for (const RegressionMethod method :
       {RegressionMethod::pcr, RegressionMethod::ridge, RegressionMethod::pls, RegressionMethod::ols}) {
    const RegressionSettings settings = chosen_settings(options, method, opened);
    expect_rows(opened, settings);
    contenders.push_back(with_source(options.batches.list.name(), [&] { return contender(opened, settings); }));
  }
  const Contender& best =
      options.method ? contenders[*options.method]
                     : *std::min_element(contenders.begin(), contenders.end(),
                                         [](const auto& a, const auto& b) { return a.held_out_um < b.held_out_um; });
  std::optional<Contender> effects;
  if (!options.model.empty()) {
    const ProgressLine progress;
    effects = physical(options, opened);
  }
  const BatchModel model = trained(opened.batches, {}, opened.columns, best.settings,
                                   [&](std::size_t k) { return read_batch(opened.files[k]); });
  write_bytes(options.out, write_batch_model(model));
  if (options.json) {
    TrainedOnBatches result{
        model.columns.target, opened.batches.size(), model.held_out_rmse_um, model.half_width_um, {}, {},
        opened.remarks};
    for (const Contender& one : contenders) result.methods.push_back({one, &one == &best});
    if (effects) result.effects.value = {options.model, *effects};
    print_json(json_of(result));
  } else {
    print_text(options, opened, contenders, effects, model);
  }
  wrote_line(options.out);
}

std::vector<CLI::Option*> add_choice_options(CLI::App& command, TrainArguments& options) {
  ChoiceOptions& choice = options.choice;
  add_source(
      command, "--for", choice.job,
      "the job at hand, a series of its temperatures: train on the batches like it; with the target it is checked")
      ->type_name("DATA");
  std::vector<CLI::Option*> added;
  added.push_back(
      command
          .add_option("--fall", choice.selection.fall, "with --for: how far RMSE_m must fall below all those before it")
          ->check(number_within(0.0, 1.0))
          ->type_name("SHARE")
          ->capture_default_str());
  added.push_back(command.add_option("--random", choice.random.choices, "with --for: random choices to compare with")
                      ->check(number_within(0, 100000))
                      ->type_name("N")
                      ->capture_default_str());
  added.push_back(command.add_option("--seed", choice.random.seed, "of the random choices")
                      ->type_name("N")
                      ->check(number_within(0, kLargestSeed))
                      ->capture_default_str());
  add_choice(command, "--take", {"paper", "held-out", "weights", "all"}, "weights",
             "with --for: whose model is written and shown first", [&](std::size_t at) { choice.take = at; });
  added.push_back(command.get_option("--take"));
  added.push_back(command.add_flag("--every", choice.every, "with --for: list every batch"));
  return added;
}

}  // namespace

void add_train(CLI::App& app) {
  const auto options = std::make_shared<TrainArguments>();
  CLI::App* command = app.add_subcommand("train", "A regression of thermal error on temperatures over many tests");
  add_batch_options(*command, options->batches);
  add_method_option(*command, options->method, "the best by batches left out");
  command->add_option("--components", options->components, "of pcr or pls; otherwise chosen by batches left out")
      ->check(CLI::Range(1, 10000).description(""))
      ->type_name("N");
  command
      ->add_option(
          "--share", options->share,
          "pcr: the fewest components that explain this share of the inputs, such as 0.99; with --for anew for each "
          "choice of batches")
      ->check(number_within(0.0, 1.0))
      ->type_name("SHARE");
  command->add_option("--penalty", options->penalty_K2, "of ridge, K^2 a row; otherwise chosen by batches left out")
      ->check(number_within(0.0, 1e9))
      ->type_name("K2");
  command->add_option("--model", options->model, "a model of effects, .toml, in the same contest; it is not written")
      ->type_name("FILE");
  command->add_flag(
      "--effects", options->effects,
      "a regression on the catalogue's effects instead, which runs live; RUNS may be one series or session");
  command->add_flag("--few", options->few, "with --effects: some ten effects, nine selections averaged");
  add_max_gap(*command, options->max_gap_s);
  const std::vector<CLI::Option*> of_a_choice = add_choice_options(*command, *options);
  command->add_option("--out", options->out, "write the model, .json; with --for it may be left out")
      ->type_name("FILE")
      ->check(name_that_ends_in({".json"}));
  command->add_flag("--json", options->json, "the result for a program");
  command->footer(
      "Example:\n"
      "  ballbar train sample-runs/batches-tan2024/runs.csv --target y_um --out model.json\n"
      "  ballbar train sample-runs/spindle-46h/measured.csv --effects --target ch1_um --out ch1.json\n"
      "  ballbar train sample-runs/batches-tan2024/runs.csv --target y_um --for sample-runs/batches-tan2024/test1.csv");
  command->callback([options, of_a_choice] { run(*options, of_a_choice); });
}

}  // namespace ballbar::commands
