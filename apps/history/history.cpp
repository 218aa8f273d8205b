// `ballbar history FOLDER...`: the tests of a machine over time, its squareness and scales.
#include "ballbar/history/history.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>

#include "ballbar/error.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "ballbar/nearest_name.hpp"
#include "commands.hpp"
#include "history/history_files.hpp"
#include "history/history_page.hpp"
#include "history/history_result.hpp"
#include "history/history_text.hpp"
#include "history/test_files.hpp"
#include "page/report_page.hpp"
#include "terminal/caller.hpp"
#include "terminal/option_checks.hpp"
#include "terminal/output_guard.hpp"
#include "terminal/stderr_line.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar::commands {
namespace {

struct HistoryArguments {
  std::vector<std::string> folders;
  std::vector<std::string> tolerances;
  std::vector<std::string> out;  // each by its ending
  StatedCircle circle;
  bool all = false;
  bool strict = false;
  bool json = false;
};

// NAME=VALUE: from -VALUE to VALUE.
Tolerance tolerance_of(const std::string& text) {
  const std::size_t equals = text.find('=');
  const auto wrong = [&] {
    return CLI::ValidationError(
        fmt::format("--tolerance {}: expected NAME=VALUE with a number above 0", in_quotes(text)));
  };
  if (equals == std::string::npos || equals == 0) throw wrong();
  const std::optional<double> value = finite_number(std::string_view(text).substr(equals + 1));
  if (!value || !(*value > 0.0)) throw wrong();
  return {text.substr(0, equals), -*value, *value};
}

// A tolerance on what no test has would never be met.
void expect_known(const std::vector<Tolerance>& tolerances, const std::vector<MachineTest>& tests) {
  if (tolerances.empty()) return;
  std::vector<std::string_view> names;
  for (const MachineTest& test : tests) {
    for (const TestQuantity& quantity : test.quantities) {
      if (!quantity.of_set_up) names.push_back(quantity.name);
    }
  }
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  for (const Tolerance& tolerance : tolerances) {
    if (names.empty() || std::binary_search(names.begin(), names.end(), tolerance.quantity)) continue;
    throw Error(fmt::format("--tolerance: expected a quantity of these tests, found {}; the nearest is {}.",
                            in_quotes(tolerance.quantity), nearest_name(tolerance.quantity, names)));
  }
}

std::string title_of(const std::vector<std::string>& folders) {
  std::error_code error;
  const std::string name = std::filesystem::weakly_canonical(folders.front(), error).filename().string();
  return folders.size() == 1 ? name : fmt::format("{} and {} more", name, folders.size() - 1);
}

void run(const HistoryArguments& options) {
  std::vector<Tolerance> tolerances;
  tolerances.reserve(options.tolerances.size());
  for (const std::string& text : options.tolerances) tolerances.push_back(tolerance_of(text));
  const auto is_page = [](const std::string& path) { return path.ends_with(".html"); };
  if (std::any_of(options.out.begin(), options.out.end(), is_page)) expect_page("--out");
  const TestFiles files = read_tests(options.folders, options.strict, options.circle);
  expect_no_input(options.out, files.files);
  expect_known(tolerances, files.tests);
  const std::vector<MachineHistory> machines = history_of(files.tests, tolerances);
  const auto json = [&] { return json_of(result_of(files, machines)); };
  for (const std::string& path : options.out) {
    write_bytes(path, is_page(path)            ? history_page(title_of(options.folders), files, machines)
                      : path.ends_with(".csv") ? history_csv(files.tests)
                                               : json().dump(2) + '\n');
  }
  options.json ? print_json(json()) : fmt::print("{}", history_text(files, machines, options.all));
  for (const std::string& path : options.out) wrote_line(path);
}

}  // namespace

void add_history(CLI::App& app) {
  const auto options = std::make_shared<HistoryArguments>();
  CLI::App* command = app.add_subcommand("history", "A machine over its tests: changes, trends, squareness, scales");
  command->add_option("FOLDER", options->folders, "folders of .b5r files or ballbar logs, with those below")
      ->required()
      ->type_name("");
  command
      ->add_option("--tolerance", options->tolerances,
                   "limit of a quantity, to both sides of 0; goes before the file's; may be repeated")
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false);
  command->add_flag("--all", options->all, "show quantities too that say nothing");
  add_radius(*command, options->circle);
  command->add_flag("--strict", options->strict, "stop at a file that would be skipped");
  command
      ->add_option("--out", options->out,
                   "write .csv: one row a test and quantity; .json; or .html: a page with pictures of all quantities; "
                   "may be repeated")
      ->type_name("FILE")
      ->allow_extra_args(false)
      ->check(name_that_ends_in({".csv", ".json", ".html"}));
  command->add_flag("--json", options->json, "the result for a program");
  command->footer("Example:\n  ballbar history sample-runs/machine-history --tolerance backlash_a_pos=5");
  command->callback([options] { run(*options); });
}

}  // namespace ballbar::commands
