// `ballbar simulate`: a virtual machine's session as files, the truth in a file of its own; with --hidden sets in which
// effects may be hidden.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <random>
#include <string_view>

#include "ballbar/formats/text/file_bytes.hpp"
#include "ballbar/units.hpp"
#include "commands.hpp"
#include "simulate/fleet_files.hpp"
#include "simulate/fleet_toml.hpp"
#include "simulate/hidden_sets.hpp"
#include "simulate/machine_toml.hpp"
#include "simulate/shaft_images.hpp"
#include "simulate/simulated_files.hpp"
#include "terminal/caller.hpp"
#include "terminal/option_checks.hpp"

namespace ballbar::commands {
namespace {

namespace fs = std::filesystem;

struct SimulateArguments {
  std::string machine;
  std::string out;
  std::string truth;
  std::optional<std::int64_t> seed;
  bool b5r = false;
  bool force = false;
  bool json = false;
  bool hidden = false;
  int sets = 20;
};

// Beside the folder, not in it: whoever is given the run is not given the answer.
fs::path truth_file(const SimulateArguments& options) {
  if (!options.truth.empty() || options.out.empty()) return options.truth;
  fs::path folder = (fs::path(options.out) / "").lexically_normal().parent_path();  // no trailing slash
  if (folder.empty() || folder.filename() == "." || folder.filename() == "..") {
    folder = (fs::absolute(options.out) / "").lexically_normal().parent_path();
  }
  return folder.string() + "-truth.csv";
}

std::string_view method_name(const VirtualMachine& machine) {
  return machine.series ? std::string_view("series") : name_of(machine.method);
}

void print_text(const VirtualMachine& machine, const SimulatedSession& simulated,
                const std::vector<SimulatedFile>& files, const SimulateArguments& options, const fs::path& truth) {
  const std::vector<double>& time_s = machine.series ? simulated.series.time_s : machine.test_s;
  fmt::print("simulated  {}, {} {}{} over {:g} min, seed {}\n", method_name(machine), time_s.size(),
             machine.series ? "row" : "test", time_s.size() == 1 ? "" : "s", min_from_s(time_s.back() - time_s.front()),
             machine.seed);
  if (files.size() == 1) {
    fmt::print("written    {}: {}\n", options.out, files.front().name);
  } else {
    fmt::print("written    {}: {} files, {} to {}\n", options.out, files.size(), files.front().name, files.back().name);
  }
  fmt::print("truth      {} (kept apart: no other command reads it)\n", truth.string());
}

SimulatedRun result_of(const VirtualMachine& machine, const SimulatedSession& simulated,
                       const std::vector<SimulatedFile>& files, const SimulateArguments& options,
                       const fs::path& truth) {
  SimulatedRun result{std::string(method_name(machine)), {}, {}, machine.seed, options.out, {}, truth.string()};
  (machine.series ? result.rows : result.tests) =
      machine.series ? simulated.series.time_s.size() : machine.test_s.size();
  for (const SimulatedFile& file : files) result.files.push_back(file.name);
  return result;
}

// Each test a .b5r, in a folder of its machine.
void run_fleet(const SimulateArguments& options, std::string_view bytes) {
  VirtualFleet fleet = read_fleet(bytes, options.machine);
  if (options.seed) fleet.seed = static_cast<std::uint64_t>(*options.seed);
  const fs::path truth = truth_file(options);
  const WrittenFleet written = write_fleet(fleet, options.out, truth, options.force);
  if (options.json) {
    print_json(json_of(
        SimulatedFleet{written.machines, fleet.months, fleet.seed, options.out, written.files, truth.string()}));
    return;
  }
  fmt::print("simulated  a fleet of {} machines over {} months, seed {}\n", written.machines, fleet.months, fleet.seed);
  fmt::print("written    {}: {} tests, one folder per machine\n", options.out, written.files);
  fmt::print("truth      {} (kept apart: no other command reads it)\n", truth.string());
}

// Of the options, those that go with `way`.
void expect_only(const CLI::App& command, const std::string& way, const std::vector<std::string>& names) {
  for (const CLI::Option* option : command.get_options()) {
    const std::string name = option->get_name(option->get_positional());
    if (option->count() == 0 || name == way || std::find(names.begin(), names.end(), name) != names.end()) continue;
    throw CLI::ValidationError(names.empty()
                                   ? fmt::format("expected the options of {} behind it, found {} before it", way, name)
                                   : fmt::format("{}: expected only {}, found {}", way, fmt::join(names, ", "), name));
  }
}

void run_hidden(const SimulateArguments& options, const CLI::App& command) {
  expect_only(command, "--hidden", {"--n", "--out", "--seed", "--json"});
  if (options.out.empty()) throw CLI::RequiredError("--out");
  std::random_device random;
  const std::uint64_t seed =
      options.seed ? static_cast<std::uint64_t>(*options.seed) : (std::uint64_t{random()} << 31) ^ random();
  const auto count = static_cast<std::size_t>(options.sets);
  write_hidden_sets(options.out, count, seed);
  const std::string answers = answers_file(options.out).string();
  if (options.json) {
    print_json(json_of(MadeSets{options.out, count, answers}));
    return;
  }
  fmt::print("written  {}: {} data set{}; README.txt explains their use\n", options.out, count, count == 1 ? "" : "s");
  fmt::print("answers  {}\n", answers);
}

void run(const SimulateArguments& options, CLI::App& command) {
  if (options.hidden) return run_hidden(options, command);
  expect_none_given({command.get_option("--n")}, "--hidden");
  if (options.machine.empty()) throw CLI::RequiredError("MACHINE");
  if (options.out.empty()) throw CLI::RequiredError("--out");
  const std::string bytes = read_bytes(options.machine, kLargestText);
  if (is_fleet(bytes)) {
    run_fleet(options, bytes);
    return;
  }
  VirtualMachine machine = read_machine(bytes, options.machine);
  const std::vector<ShaftImage> images = read_shaft_images(bytes, options.machine);
  if (options.seed) machine.seed = static_cast<std::uint64_t>(*options.seed);
  const SimulatedSession simulated = simulate(machine);
  std::vector<SimulatedFile> files = simulated_files(simulated, options.b5r);
  if (machine.spindle) {
    for (SimulatedFile& image : shaft_image_files(images, *machine.spindle, simulated.profiles)) {
      files.push_back(std::move(image));
    }
  }
  const fs::path truth = truth_file(options);
  write_simulated(files, simulated.truth, options.out, truth, options.force);
  options.json ? print_json(json_of(result_of(machine, simulated, files, options, truth)))
               : print_text(machine, simulated, files, options, truth);
}

}  // namespace

void add_simulate(CLI::App& app) {
  const auto options = std::make_shared<SimulateArguments>();
  CLI::App* command = app.add_subcommand("simulate", "Simulate recordings and signals of a virtual machine");
  command->add_option("MACHINE", options->machine, "machine.toml (one machine) or fleet.toml (many)")->type_name("");
  command->add_option("--out", options->out, "write the files to a new or empty folder")->type_name("DIR");
  command->add_option("--truth", options->truth, "write the truth to FILE; default: DIR-truth.csv")->type_name("FILE");
  command
      ->add_option("--seed", options->seed,
                   "seed of the noise; default: the machine's own, with --hidden a new one each time")
      ->check(whole_number_within(0, kLargestSeed))
      ->type_name("N");
  command->add_flag("--b5r", options->b5r, "method circles: write only .b5r files");
  command->add_flag("--force", options->force, "replace existing files");
  command->add_flag("--hidden", options->hidden,
                    "without MACHINE: write data sets with hidden effects and their answers");
  command
      ->add_option("--n", options->sets, fmt::format("with --hidden: number of sets, 1 to {}; default: 20", kMostSets))
      ->check(whole_number_within(1, kMostSets))
      ->type_name("N");
  command->add_flag("--json", options->json, "print the result as JSON");
  add_score(*command);
  command->get_subcommand("score")->parse_complete_callback([command] { expect_only(*command, "score", {}); });
  command->footer(
      "Examples:\n"
      "  ballbar simulate sample-runs/two-arcs-he2015/machine.toml --out my-run\n"
      "  ballbar drift my-run/session.toml\n"
      "  ballbar simulate --hidden --n 20 --out hidden\n"
      "  ballbar simulate score hidden");
  command->callback([options, command] {
    if (command->get_subcommands().empty()) run(*options, *command);
  });
}

}  // namespace ballbar::commands
