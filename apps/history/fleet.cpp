// `ballbar fleet FOLDER...`: the tests of many machines. The package of Python does it, in the place of this process.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/error.hpp"
#include "commands.hpp"
#include "terminal/option_checks.hpp"

namespace ballbar::commands {
namespace {

namespace fs = std::filesystem;

constexpr const char* kStart = R"(import sys
try:
    from ballbar.__main__ import fleet
except ImportError as error:
    sys.exit("ballbar: fleet: expected the package ballbar of Python with numpy, found: %s; on Debian install "
             "python3-ballbar, python3-pandas and python3-distributed" % error)
except KeyboardInterrupt:
    sys.exit(130)
sys.exit(fleet(sys.argv[1:])))";

bool is_environment_on() { return std::getenv("VIRTUAL_ENV") != nullptr || std::getenv("CONDA_PREFIX") != nullptr; }

struct FleetArguments {
  std::vector<std::string> paths, tolerances, out;
  std::string table, scheduler;
  std::optional<int> workers;
  std::optional<double> false_discovery_rate;
  bool json = false;
};

std::vector<std::string> words_of(const FleetArguments& options) {
  std::vector<std::string> words;
  const auto say = [&](const char* name, const std::string& value) {
    words.emplace_back(fmt::format("{}={}", name, value));
  };
  if (!options.table.empty()) say("--table", options.table);
  if (options.workers) say("--workers", fmt::format("{}", *options.workers));
  if (!options.scheduler.empty()) say("--scheduler", options.scheduler);
  for (const std::string& tolerance : options.tolerances) say("--tolerance", tolerance);
  if (options.false_discovery_rate) say("--false-discovery-rate", fmt::format("{}", *options.false_discovery_rate));
  for (const std::string& path : options.out) say("--out", path);
  if (options.json) words.emplace_back("--json");
  words.emplace_back("--");
  words.insert(words.end(), options.paths.begin(), options.paths.end());
  return words;
}

// Where the package is beside this program: in a tree that is built, or below the same prefix. Below /usr/lib Python
// finds it by itself, and in an environment that is on the environment's own is wanted: first on the path, the modules
// beside it would hide those of the environment.
void find_package_beside() {
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

void run(const FleetArguments& options) {
  find_package_beside();
  std::vector<std::string> words{python(), "-P", "-c", kStart};  // -P: a numpy.py of this folder is not run
  for (std::string& word : words_of(options)) words.push_back(std::move(word));
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  std::fflush(nullptr);
  execvp(arguments.front(), arguments.data());
  throw Error(fmt::format("fleet: expected the program {} to run the package ballbar of Python, found: {}.",
                          words.front(), std::strerror(errno)));
}

}  // namespace

void add_fleet(CLI::App& app) {
  const auto options = std::make_shared<FleetArguments>();
  CLI::App* command = app.add_subcommand("fleet", "The tests of many machines: a table, and which machine needs what");
  command->add_option("FOLDER", options->paths, "folders of .b5r files, files, or patterns such as 'plant/**/*.b5r'")
      ->required()
      ->type_name("");
  command->add_option("--table", options->table, "where the table is kept: only what is new or changed is read")
      ->type_name("FOLDER");
  command->add_option("--workers", options->workers, "processes that read, by Dask; default: this one, on all cores")
      ->type_name("N")
      ->check(number_within(1, 1024));
  command->add_option("--scheduler", options->scheduler, "of a Dask cluster, tcp://host:8786, whose workers read")
      ->type_name("ADDRESS");
  command->add_option("--tolerance", options->tolerances, "limit of a quantity, to both sides of 0; may be repeated")
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false)
      ->check(name_and_number());
  command
      ->add_option("--false-discovery-rate", options->false_discovery_rate,
                   "share of what is called that may be by chance; default 0.05")
      ->type_name("RATE")
      ->check(number_within(0, 1));
  command
      ->add_option("--out", options->out, "write .csv: the table; .json: what it says; .html: a page; may be repeated")
      ->type_name("FILE")
      ->allow_extra_args(false)
      ->check(name_that_ends_in({".csv", ".json", ".html"}));
  command->add_flag("--json", options->json, "the result for a program");
  command->footer("Example:\n  ballbar fleet sample-runs/machine-history --table plant-table");
  command->callback([options] { run(*options); });
}

}  // namespace ballbar::commands
