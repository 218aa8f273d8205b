// `ballbar plan DATA --model M`: the run of the machine that would decide which effect is missing, and how surely.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "commands.hpp"
#include "model/model_options.hpp"
#include "plan/plan_files.hpp"
#include "plan/plan_result.hpp"
#include "plan/plan_sentence.hpp"
#include "terminal/caller.hpp"
#include "terminal/option_checks.hpp"
#include "terminal/stderr_line.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar::commands {
namespace {

struct PlanArguments {
  ModelOptions model;
  TestPlanOptions plan;
  std::vector<std::string> can;
  std::string out;
  bool details = false;
  bool json = false;
};

constexpr std::size_t kTests = 6, kCurves = 6;  // unasked

void print_text(const PlanReport& report, const ModelData& data, const std::string& target, bool details) {
  const TestPlan& plan = report.plan;
  fmt::print("{}\n{}\n\n{}", data.title, target, wrapped(report.sentence));
  if (plan.tests.empty()) return;
  Table tests({"test", "hours", "all named", "part named", "wrong name", "simulated cases"});
  const auto shown = [&](std::size_t all, std::size_t most) { return details ? all : std::min(all, most); };
  for (std::size_t k = 0; k < shown(plan.tests.size(), kTests); ++k) {
    const ExpectedTest& test = plan.tests[k];
    tests.add({text_of(name_of(test)), fmt::format("{:g}", test.hours),
               fmt::format("{:.2f} ± {:.2f}", test.p_right, test.p_right_sigma), fmt::format("{:.2f}", test.p_part),
               fmt::format("{:.2f}", test.p_wrong), fmt::format("{}", test.truths)});
  }
  fmt::print("\n{}", tests.text(table_width()));
  if (details) {
    fmt::print("{}", wrapped("The simulated cases are drawn from what these data leave possible. all named: share of "
                             "them in which data and run together name everything that is missing and nothing else. "
                             "part named: at least one effect that is not named now. wrong name: another effect."));
  }
  Table curves({"possibly missing", "probability now"});
  for (std::size_t k = 0; k < shown(plan.curves.size(), kCurves); ++k)
    curves.add({label_of(plan.curves[k]), fmt::format("{:.2f}", plan.curves[k].p)});
  if (!plan.curves.empty()) fmt::print("\n{}", curves.text(table_width()));
  if (!details) fmt::print("\n{}", details_text("all tests and candidates, and what the columns mean"));
}

// Spread of the curves at each time, beside the readings' sigma.
std::vector<double> separation_of(const TestPlan& plan) {
  std::vector<double> separation;
  separation.reserve(plan.time_s.size());
  for (std::size_t i = 0; i < plan.time_s.size(); ++i) {
    double low = plan.curves.front().um[i], high = low;
    for (const ExpectedCurve& curve : plan.curves) {
      low = std::min(low, curve.um[i]);
      high = std::max(high, curve.um[i]);
    }
    separation.push_back(plan.sigma_um > 0.0 ? (high - low) / plan.sigma_um : 0.0);
  }
  return separation;
}

PlanContents contents_of(const PlanReport& report, const PlanArguments& options, const ModelData& data,
                         const std::string& target) {
  const TestPlan& plan = report.plan;
  PlanContents contents;
  contents.schedule = plan.tests.front().schedule;
  contents.title = fmt::format("What is missing in {}: {}", target, text_of(name_of(plan.tests.front())));
  contents.text = text_of(report.sentence);
  for (const ExpectedCurve& curve : plan.curves) {
    contents.curves.push_back(
        {label_of(curve), curve.p, plan.time_s, curve.um, std::vector<double>(plan.time_s.size(), plan.sigma_um)});
  }
  if (!plan.curves.empty()) contents.separation = separation_of(plan);
  for (const Column& column : data.series->columns) {
    if (column.role != Role::measured || column.name == target) contents.columns_to_log.push_back(column.name);
  }
  if (options.plan.max_rpm > 0.0) contents.max_rpm = options.plan.max_rpm;
  return contents;
}

void run(PlanArguments options) {
  if (!options.out.empty()) expect_plan_folder(options.out);
  for (const std::string& what : options.can) {
    options.plan.can_load = options.plan.can_load || what == "load";
    options.plan.can_room = options.plan.can_room || what == "room";
    options.plan.can_coolant = options.plan.can_coolant || what == "coolant";
  }
  const ModelData data = open_data(options.model);
  if (data.level == Level::recording) {
    throw Error(
        fmt::format("{}: expected a series or a session of drift, found recordings; `ballbar errors` says of a "
                    "ballbar test what is out, `ballbar diagnose` of a rotating axis which circles to drive next.",
                    options.model.data.front().name()));
  }
  expect_clock(data, "to plan from");
  const Model model = open_model(options.model, data);
  say_start(options.model, data);
  if (model.targets.size() != 1) {
    throw Error(fmt::format("expected one target to plan for, found {}; --target chooses one.", model.targets.size()));
  }
  options.plan.search.catalogue = options.model.catalogue;
  const ProgressLine line;
  if (!options.json || progress_is_taken()) {
    options.plan.search.progress = [](std::string_view step) { show_progress(std::string(step)); };
    options.plan.simulating = [](const ExpectedTest& test, std::size_t done, std::size_t count) {
      show_progress(fmt::format("simulating {:g} h of {}, {} of {}", test.hours, text_of(name_of(test)), done, count));
    };
  }
  PlanReport report;
  report.plan =
      with_source(options.model.data.front().name(), [&] { return test_plan(model, *data.series, 0, options.plan); });
  report.sentence = sentence_of(report.plan, options.plan.most_hours);
  show_progress({});
  if (options.json) {
    print_json(json_of(report));
  } else {
    print_text(report, data, model.targets.front(), options.details);
  }
  if (options.out.empty() || report.plan.tests.empty()) {
    if (!options.out.empty()) stderr_line("no test is proposed; nothing was written to " + options.out);
    return;
  }
  write_plan(options.out, contents_of(report, options, data, model.targets.front()));
  wrote_line(options.out + ": schedule.csv, program.nc, checklist.txt, plan.svg");
}

}  // namespace

void add_plan(CLI::App& app) {
  const auto options = std::make_shared<PlanArguments>();
  CLI::App* command = app.add_subcommand("plan", "The run of the machine that would decide what is missing");
  add_model_options(*command, options->model, false);
  add_also_input(*command, options->model);
  command->add_option("--hours", options->plan.most_hours, "the longest run that can be made")
      ->type_name("H")
      ->capture_default_str()
      ->check(number_within(1.0, 168.0));
  command->add_option("--max-rpm", options->plan.max_rpm, "highest speed; default: that of the data")
      ->type_name("RPM")
      ->check(number_within(1.0, 1e6));
  command->add_option("--can", options->can, "what can be moved beside the speed: load, room, coolant")
      ->delimiter(',')
      ->type_name("WHAT")
      ->allow_extra_args(false)
      ->check(CLI::IsMember({"load", "room", "coolant"}));
  command->add_option("--out", options->out, "a new folder: schedule, program of the machine, check list, picture")
      ->type_name("FOLDER");
  command->add_option("--seed", options->plan.seed, "seed of the random draws")
      ->type_name("N")
      ->check(whole_number_within(0, kLargestSeed));
  add_details(*command, options->details);
  command->add_flag("--json", options->json, "print the result as JSON");
  command->footer(
      "Example:\n"
      "  ballbar plan sample-runs/hidden-effect/01/data.csv --model sample-runs/hidden-effect/01/model.toml --hours 8");
  command->callback([options] { run(*options); });
}

}  // namespace ballbar::commands
