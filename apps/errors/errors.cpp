// `ballbar errors FILE...`: the errors of the axes in ballbar tests: ranked for one test, one row per test for many,
// what changed between two.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ballbar/formats/text/file_bytes.hpp"
#include "commands.hpp"
#include "errors/machine_errors_report.hpp"
#include "errors/machine_errors_result.hpp"
#include "errors/test_comparison_text.hpp"
#include "errors/test_files.hpp"
#include "errors/test_results.hpp"
#include "errors/test_table.hpp"
#include "model/model_options.hpp"
#include "terminal/caller.hpp"
#include "terminal/command_line.hpp"
#include "terminal/option_checks.hpp"
#include "terminal/stderr_line.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar::commands {
namespace {

enum class View { ranked, table, change };

struct ErrorsArguments {
  std::vector<Source> files;
  std::vector<std::string> out;
  std::optional<View> view;
  ModelOptions model;  // its file alone: which effects a model has
  ErrorsOptions how;
  bool details = false;
  bool json = false;
};

// A folder or an archive has many tests.
bool is_one_test(const std::vector<Source>& files) { return files.size() == 1 && !any_folder_of_tests(files); }

// All errors of one plane and one bar together, by what mending each gains. Returns whether a test fails its tolerance.
bool show_ranked(ErrorsArguments options) {
  if (!options.out.empty()) throw CLI::ValidationError("--out: cannot be combined with --show ranked");
  std::vector<SkippedFile> faults;
  if (any_folder_of_tests(options.files)) {
    FoundFiles found = put_recordings_below(options.files);
    if (!found.files.empty()) faults = std::move(found.faults);  // nothing: told where it is opened
  }
  if (!options.model.model.empty()) {
    options.model.data = options.files;
    const ModelData data = open_data(options.model);
    for (const Term& term : open_model(options.model, data).terms) options.how.in_the_model.insert(term.effect->name);
  }
  ErrorsReports reports = errors_reports_of(options.files, options.how);
  reports.skipped.insert(reports.skipped.end(), faults.begin(), faults.end());
  options.json ? print_json(json_value(result_of(reports))) : print_text(reports, options.details);
  for (const std::string& remark : reports.remarks) warning_line(remark);
  return any_fails(reports);
}

bool show_table(const ErrorsArguments& options) {
  TestFiles files = read_tests(names_of(options.files), options.how.strict, options.how.circle);
  if (options.how.tolerance_um) files = checked(std::move(files), *options.how.tolerance_um);
  expect_no_input(options.out, files.files);
  for (const std::string& path : options.out) {
    write_bytes(path, path.ends_with(".csv") ? test_table_csv(files.tests) : json_of(files).dump(2) + '\n');
  }
  options.json ? print_json(json_of(files)) : fmt::print("{}", test_table_text(files, options.details));
  for (const std::string& path : options.out) wrote_line(path);
  return std::any_of(files.tests.begin(), files.tests.end(),
                     [](const MachineTest& one) { return one.passes == false; });
}

// Of two tests, the first before the second.
void show_change(const ErrorsArguments& options) {
  if (!options.out.empty()) throw CLI::ValidationError("--out: cannot be combined with --show change");
  TestFiles before, after;
  if (options.files.size() == 2) {
    before = read_tests({options.files[0].name()}, options.how.strict, options.how.circle);
    after = read_tests({options.files[1].name()}, options.how.strict, options.how.circle);
  }
  if (before.tests.size() != 1 || after.tests.size() != 1) {
    throw CLI::ValidationError(fmt::format("--show change: expected two tests, one file or folder each, found {}",
                                           options.files.size() == 2
                                               ? fmt::format("{} and {}", before.tests.size(), after.tests.size())
                                               : fmt::format("{}", options.files.size())));
  }
  const TestComparison comparison = compared_tests(before.tests.front(), after.tests.front());
  options.json ? print_json(json_of(comparison)) : fmt::print("{}", comparison_text(comparison, options.details));
}

// Returns whether a test fails its tolerance.
bool run(const ErrorsArguments& options, const std::vector<CLI::Option*>& of_a_ranking) {
  const auto found =
      std::find_if(of_a_ranking.begin(), of_a_ranking.end(), [](const auto* one) { return one->count() > 0; });
  if (found != of_a_ranking.end()) {
    const bool is_other = options.view && *options.view != View::ranked;
    if (is_other || !options.out.empty()) {
      const char* const other = !options.out.empty()           ? "--out"
                                : options.view == View::change ? "--show change"
                                                               : "--show table";
      throw CLI::ValidationError(fmt::format("{}: cannot be combined with {}", (*found)->get_name(), other));
    }
    return show_ranked(options);
  }
  if (options.view == View::change) {
    if (options.how.tolerance_um) throw CLI::ValidationError("--tolerance: cannot be combined with --show change");
    show_change(options);
    return false;
  }
  const bool ranked = options.view ? *options.view == View::ranked : options.out.empty() && is_one_test(options.files);
  return ranked ? show_ranked(options) : show_table(options);
}

}  // namespace

void add_errors(CLI::App& app) {
  const auto options = std::make_shared<ErrorsArguments>();
  CLI::App* command = app.add_subcommand("errors", "Compute the axis errors of ballbar tests");
  add_sources(*command, "FILE", options->files, ".b5r files, ballbar logs, and folders of them, searched recursively")
      ->required()
      ->type_name("");
  add_choice(*command, "--show", {"ranked", "table", "change"}, "",
             "ranked: errors of a plane, largest gain first; table: one row per test; change: differences of two "
             "tests; default: ranked for one test, else table",
             [options](std::size_t at) { options->view = static_cast<View>(at); });
  command
      ->add_option("--tolerance", options->how.tolerance_um,
                   "largest circularity that passes; exit status 3 if a test fails it or a limit in its file")
      ->type_name("UM")
      ->check(number_within(0.0, 1e6));
  add_choice(*command, "--prior", {"usual", "none"}, "usual",
             "ranked: prior of errors that the readings determine poorly",
             [options](std::size_t at) { options->how.prior = at == 0; });
  add_source(*command, "--model", options->model.model, "ranked: mark the effects of this model.toml of recordings")
      ->type_name("FILE");
  add_radius(*command, options->how.circle);
  command->add_flag("--strict", options->how.strict, "stop at the first file that cannot be used");
  command->add_option("--out", options->out, "table: write one row per test to FILE (.csv or .json); may be repeated")
      ->type_name("FILE")
      ->allow_extra_args(false)
      ->check(name_that_ends_in({".csv", ".json"}));
  add_details(*command, options->details);
  command->add_flag("--json", options->json, "print the result as JSON");
  command->footer(
      "Examples:\n"
      "  ballbar errors sample-runs/qc20-style-b5r/00.b5r --tolerance 6\n"
      "  ballbar errors sample-runs/machine-history --tolerance 6 --out errors.csv\n"
      "  ballbar errors before.b5r after.b5r --show change");
  const std::vector<CLI::Option*> of_a_ranking{command->get_option("--prior"), command->get_option("--model")};
  command->callback([options, of_a_ranking, command] {
    constexpr int kFailsTolerance = 3;
    const bool fails = run(*options, of_a_ranking);
    if (CommandLine* const line = line_of(*command); fails && line != nullptr) line->status = kFailsTolerance;
  });
}

}  // namespace ballbar::commands
