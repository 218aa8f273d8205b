// `ballbar diagnose DATA --model M`: which physical effect the model lacks, or that the data cannot tell.
#include "ballbar/diagnosis/verdict/diagnose.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>

#include "ballbar/error.hpp"
#include "ballbar/formats/recordings/test_folder.hpp"
#include "commands.hpp"
#include "diagnose/diagnosis_result.hpp"
#include "diagnose/next_command.hpp"
#include "model/model_options.hpp"
#include "model/residual_report.hpp"
#include "terminal/caller.hpp"
#include "terminal/option_checks.hpp"
#include "terminal/stderr_line.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar::commands {
namespace {

struct DiagnoseArguments {
  ModelOptions model;
  DiagnoseOptions how;
  bool details = false;
  bool json = false;
};

DiagnosisReport diagnosed(const DiagnoseArguments& options, const Model& of_one_target,
                          const std::shared_ptr<const ModelData>& data) {
  const ProgressLine line;
  Workbench bench =
      workbench_of(options.model, data, of_one_target, diagnosis_options(options.how, of_one_target.targets.front()));
  return diagnosis_report_of(options.model, bench);
}

// The text or JSON of one of several targets; why there is none where it cannot be fitted, as without values.
void show_one_of_several(const DiagnoseArguments& options, const Model& model,
                         const std::shared_ptr<const ModelData>& data, std::size_t target,
                         Targets<std::variant<DiagnosisReport, NotDiagnosed>>& all) {
  if (target > 0 && !options.json) fmt::print("\n");
  try {
    const DiagnosisReport diagnosis_report =
        diagnosed(options, of_one_target(model, options.model, *data->series, target), data);
    if (options.json) {
      all.targets.emplace_back(diagnosis_report);
    } else {
      print_text(diagnosis_report, target == 0 || options.details ? data->title : "",
                 {options.details, model.targets.size()});
    }
  } catch (const Error& error) {
    if (options.json) {
      all.targets.emplace_back(NotDiagnosed{model.targets[target], error.what()});
    } else {
      if (target == 0) fmt::print("{}\n", data->title);
      fmt::print("{}\n\n{}", model.targets[target], wrapped(fmt::format("Not diagnosed: {}", error.what())));
    }
  }
}

// Of folders and archives that are no session, the recordings below them; they go in place of these.
std::vector<SkippedFile> expand(ModelOptions& options) {
  if (!options.model.empty() || !any_folder_of_tests(options.data)) return {};
  FoundFiles found = put_recordings_below(options.data);
  return found.files.empty() ? std::vector<SkippedFile>() : found.faults;  // nothing: told where it is opened
}

// Recordings of two linear axes have a command of their own. `typed`: the files of the command line.
void expect_no_circles_of_linear_axes(const ModelOptions& options, const ModelData& data,
                                      const std::vector<std::string>& typed) {
  if (data.level != Level::recording || data.motion != Motion::linear_axes) return;
  std::vector<std::string> words{"ballbar errors"};
  for (const std::string& name : typed) words.push_back(shell_word(name));
  if (typed.size() > 1 || options.data.size() > 1) words.emplace_back("--show ranked");
  if (!options.model.empty()) words.insert(words.end(), {"--model", shell_word(options.model.name())});
  if (options.circle.radius_mm) words.push_back(fmt::format("--radius {:g}mm", *options.circle.radius_mm));
  throw Error(fmt::format(
      "{}: expected a series, a session, or recordings of a rotating axis, found circles that two linear "
      "axes drive, whose errors are ranked by {}.",
      typed.front(),
      options.data.front().is_path() ? fmt::format("{}", fmt::join(words, " ")) : "ballbar.errors(..., ranked=True)"));
}

void run(DiagnoseArguments options) {
  const std::vector<std::string> typed = names_of(options.model.data);
  for (const SkippedFile& fault : expand(options.model)) warning_line(fault.why);
  options.model.says_sensor_jumps = true;
  const auto data = std::make_shared<const ModelData>(open_data(options.model));
  expect_no_circles_of_linear_axes(options.model, *data, typed);
  const Model model = open_model(options.model, *data);
  say_start(options.model, *data);
  if (model.targets.size() == 1) {
    DiagnosisReport diagnosis_report = diagnosed(options, model, data);
    diagnosis_report.stand_ins = stand_ins_of(options.model, options.how, model, *data);
    options.json ? print_json(json_of(diagnosis_report)) : print_text(diagnosis_report, data->title, {options.details});
    return;
  }
  Targets<std::variant<DiagnosisReport, NotDiagnosed>> all;
  for (std::size_t target = 0; target < model.targets.size(); ++target) {
    show_one_of_several(options, model, data, target, all);
  }
  if (options.json) {
    print_json(json_of(all));
  } else if (!options.details) {
    fmt::print("\n{}", details_text(fmt::format("each target in full: {}", details_of_diagnosis())));
  }
}

}  // namespace

void add_diagnose(CLI::App& app) {
  const auto options = std::make_shared<DiagnoseArguments>();
  CLI::App* command = app.add_subcommand("diagnose", "Find the physical effect that a model lacks");
  add_model_options(*command, options->model, false);
  add_also_input(*command, options->model);
  command->add_option("--tolerance", options->how.diagnosis.tolerance_um, "report smaller effects as minor")
      ->type_name("UM")
      ->check(number_within(0.0, 1e6));
  command
      ->add_option("--most-rows", options->how.diagnosis.most_rows,
                   "search at most N readings; a longer series is thinned")
      ->type_name("N")
      ->check(whole_number_within(30, 5000));
  add_details(*command, options->details);
  command->add_flag("--json", options->json, "print the result as JSON");
  command->footer(
      "Example:\n"
      "  ballbar diagnose sample-runs/spindle-46h/measured.csv --model sample-runs/spindle-46h/speed.toml "
      "--target ch3_um");
  command->callback([options] {
    options->how.progress = !options->json || progress_is_taken();
    run(*options);
  });
}

}  // namespace ballbar::commands
