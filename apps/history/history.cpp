// `ballbar history FOLDER...`: machines over their tests; of one its squareness and scales too.
#include "ballbar/history/history.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "ballbar/error.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "ballbar/internal/nearest_name.hpp"
#include "commands.hpp"
#include "errors/test_files.hpp"
#include "errors/test_table.hpp"
#include "history/found_history.hpp"
#include "history/history_page.hpp"
#include "history/history_result.hpp"
#include "history/history_text.hpp"
#include "page/report_page.hpp"
#include "terminal/caller.hpp"
#include "terminal/option_checks.hpp"
#include "terminal/stderr_line.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar::commands {
namespace {

namespace fs = std::filesystem;

struct HistoryArguments {
  std::vector<std::string> folders;
  std::vector<std::string> tolerances;
  std::vector<std::string> out;  // each by its ending
  std::string table, scheduler;
  std::optional<int> workers;
  double false_discovery_rate = 0.05;
  StatedCircle circle;
  bool details = false;
  bool strict = false;
  bool json = false;
};

// Of a cloud, or a pattern that the shell left.
bool is_for_fsspec(const std::string& path) {
  std::error_code error;
  const bool is_pattern = path.find_first_of("*?[") != std::string::npos && !fs::exists(path, error);
  return is_pattern || path.find("://") != std::string::npos;
}

bool is_for_dask(const HistoryArguments& options) {
  if (caller() != nullptr) return false;  // a program in whose place no other may run
  return !options.table.empty() || options.workers || !options.scheduler.empty() ||
         std::any_of(options.folders.begin(), options.folders.end(), is_for_fsspec);
}

// With Dask: a table that is kept, workers, file systems of a cloud. The package of Python does it.
constexpr const char* kStart = R"(import sys
try:
    from ballbar.__main__ import history
except ImportError as error:
    sys.exit("ballbar: history: expected the package ballbar of Python with numpy and pandas, found: %s; on Debian install "
             "python3-ballbar and python3-distributed" % error)
except KeyboardInterrupt:
    sys.exit(130)
sys.exit(history(sys.argv[1:])))";

bool is_environment_on() { return std::getenv("VIRTUAL_ENV") != nullptr || std::getenv("CONDA_PREFIX") != nullptr; }

// The package of this program: in a tree that is built, or below the same prefix. Below /usr/lib Python finds it by
// itself, and an environment that is on has its own: first on the path, the modules next to it would hide those of the
// environment.
void add_own_package() {
  std::error_code error;
  const fs::path folder = fs::read_symlink("/proc/self/exe", error).parent_path();
  if (error) return;
  for (const char* place : {"../python", "../lib/python3/dist-packages"}) {
    const fs::path found = (folder / place).lexically_normal();
    const bool is_installed = place != std::string_view("../python");
    if (is_installed && (is_environment_on() || found.string().starts_with("/usr/lib/"))) continue;
    if (!fs::is_directory(found / "ballbar", error)) continue;
    const char* const before = std::getenv("PYTHONPATH");
    const std::string after = before == nullptr ? "" : fmt::format(":{}", before);
    setenv("PYTHONPATH", (found.string() + after).c_str(), 1);
    return;
  }
}

// That of an environment that is on; else the system's, for which Debian's packages are.
std::string python() {
  return !is_environment_on() && access("/usr/bin/python3", X_OK) == 0 ? "/usr/bin/python3" : "python3";
}

// Ends this process, in whose place Python runs the command with these words.
void run_in_python(const std::vector<std::string>& words) {
  add_own_package();
  std::vector<std::string> line{python(), "-P", "-c", kStart};  // -P: a numpy.py of this folder is not run
  line.insert(line.end(), words.begin(), words.end());
  std::vector<char*> arguments;
  arguments.reserve(line.size() + 1);
  for (std::string& word : line) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  std::fflush(nullptr);
  execvp(arguments.front(), arguments.data());
  throw Error(fmt::format("history: expected the program {} to run the package ballbar of Python, found: {}.",
                          line.front(), std::strerror(errno)));
}

std::vector<std::string> words_of(const HistoryArguments& options) {
  if (options.strict || options.details || options.circle.radius_mm) {
    throw CLI::ValidationError(
        "--strict, --details, --radius: expected folders and files without --table, --workers, --scheduler and "
        "patterns");
  }
  std::vector<std::string> words{fmt::format("--false-discovery-rate={}", options.false_discovery_rate)};
  const auto add = [&](const char* name, const std::string& value) { words.push_back(std::string(name) + value); };
  if (!options.table.empty()) add("--table=", options.table);
  if (options.workers) add("--workers=", fmt::format("{}", *options.workers));
  if (!options.scheduler.empty()) add("--scheduler=", options.scheduler);
  for (const std::string& tolerance : options.tolerances) add("--tolerance=", tolerance);
  for (const std::string& path : options.out) add("--out=", path);
  if (options.json) words.emplace_back("--json");
  words.emplace_back("--");
  words.insert(words.end(), options.folders.begin(), options.folders.end());
  return words;
}

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

std::string title_of(const std::vector<std::string>& folders) {
  std::error_code error;
  const std::string name = fs::weakly_canonical(folders.front(), error).filename().string();
  return folders.size() == 1 ? name : fmt::format("{} and {} more", name, folders.size() - 1);
}

void run(const HistoryArguments& options) {
  HistoryOptions how;
  how.false_discovery_rate = options.false_discovery_rate;
  for (const std::string& text : options.tolerances) how.tolerances.push_back(tolerance_of(text));
  if (is_for_dask(options)) run_in_python(words_of(options));
  const auto is_page = [](const std::string& path) { return path.ends_with(".html"); };
  if (std::any_of(options.out.begin(), options.out.end(), is_page)) expect_page("--out");
  TestFiles read = read_tests(options.folders, options.strict, options.circle);
  expect_no_input(options.out, read.files);
  const FoundHistory found = found_history(std::move(read), options.folders, std::move(how));
  for (const std::string& path : options.out) {
    write_bytes(path, is_page(path)            ? history_page(title_of(options.folders), found)
                      : path.ends_with(".csv") ? test_table_csv(found.files.tests)
                                               : json_of(found).dump(2) + '\n');
  }
  options.json ? print_json(json_of(found)) : fmt::print("{}", history_text(found, options.details));
  for (const std::string& path : options.out) wrote_line(path);
}

}  // namespace

void add_history(CLI::App& app) {
  const auto options = std::make_shared<HistoryArguments>();
  CLI::App* command = app.add_subcommand("history", "Find changes and trends in the tests of machines");
  command
      ->add_option("FOLDER", options->folders,
                   "folders of .b5r files or ballbar logs, searched recursively; or patterns such as 'plant/**/*.b5r'")
      ->required()
      ->type_name("");
  command
      ->add_option("--tolerance", options->tolerances,
                   "limit of a quantity, on both sides of 0; overrides the file; may be repeated")
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false);
  command
      ->add_option("--false-discovery-rate", options->false_discovery_rate,
                   "accepted share of findings by chance; default: 0.05")
      ->type_name("RATE")
      ->check(number_within(0, 1));
  add_details(*command, options->details);
  command->add_flag("--all", options->details)->group("");  // its name before
  add_radius(*command, options->circle);
  command->add_flag("--strict", options->strict, "stop at the first file that cannot be used");
  command
      ->add_option("--out", options->out,
                   "write one row per test to FILE (.csv or .json), or a page (.html); may be repeated")
      ->type_name("FILE")
      ->allow_extra_args(false)
      ->check(name_that_ends_in({".csv", ".json", ".html"}));
  command
      ->add_option("--table", options->table, "keep the table in FOLDER and read only new or changed files, with Dask")
      ->type_name("FOLDER");
  command->add_option("--workers", options->workers, "number of Dask processes; default: this process, on all cores")
      ->type_name("N")
      ->check(whole_number_within(1, 1024));
  command->add_option("--scheduler", options->scheduler, "address of a Dask cluster, tcp://host:8786")
      ->type_name("ADDRESS");
  command->add_flag("--json", options->json, "print the result as JSON");
  command->footer("Example:\n  ballbar history sample-runs/machine-history --tolerance backlash_a_pos=5");
  command->callback([options] { run(*options); });
}

}  // namespace ballbar::commands
