// `ballbar errors FILE...`: the errors of each ballbar test, one row a test.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "ballbar/formats/text/file_bytes.hpp"
#include "commands.hpp"
#include "history/test_files.hpp"
#include "history/test_result.hpp"
#include "history/test_table.hpp"
#include "terminal/caller.hpp"
#include "terminal/option_checks.hpp"
#include "terminal/output_guard.hpp"
#include "terminal/stderr_line.hpp"

namespace ballbar::commands {
namespace {

struct ErrorsArguments {
  std::vector<std::string> paths, out;
  StatedCircle circle;
  bool strict = false, json = false;
};

void run(const ErrorsArguments& options) {
  const TestFiles files = read_tests(options.paths, options.strict, options.circle);
  expect_no_input(options.out, files.files);
  for (const std::string& path : options.out) {
    write_bytes(path, path.ends_with(".csv") ? test_table_csv(files.tests) : json_of(files).dump(2) + '\n');
  }
  options.json ? print_json(json_of(files)) : fmt::print("{}", test_table_text(files));
  for (const std::string& path : options.out) wrote_line(path);
}

}  // namespace

void add_errors(CLI::App& app) {
  const auto options = std::make_shared<ErrorsArguments>();
  CLI::App* command = app.add_subcommand("errors", "The errors of each of many ballbar tests: a table, one row a test");
  command->add_option("FILE", options->paths, ".b5r files, ballbar logs, and folders of them with those below")
      ->required()
      ->type_name("");
  add_radius(*command, options->circle);
  command->add_flag("--strict", options->strict, "stop at a file that would be skipped");
  command
      ->add_option("--out", options->out,
                   "write .csv: one row a test, each error with sigma; or .json; may be repeated")
      ->type_name("FILE")
      ->allow_extra_args(false)
      ->check(name_that_ends_in({".csv", ".json"}));
  command->add_flag("--json", options->json, "the result for a program");
  command->footer("Example:\n  ballbar errors sample-runs/machine-history --out errors.csv");
  command->callback([options] { run(*options); });
}

}  // namespace ballbar::commands
