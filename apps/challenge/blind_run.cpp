// `ballbar blind run`: what a set's machine does under a schedule, its answers untold.
#include "challenge/blind_run.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>

#include "ballbar/error.hpp"
#include "ballbar/formats/schedules/schedule_csv.hpp"
#include "ballbar/formats/series/series_csv.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "ballbar/nearest_name.hpp"
#include "challenge/blind_results.hpp"
#include "challenge/challenge_runs.hpp"
#include "terminal/caller.hpp"
#include "terminal/option_checks.hpp"

namespace ballbar::commands {
namespace {

namespace fs = std::filesystem;

struct BlindRunOptions {
  std::string set;
  std::string schedule;
  std::string out;
  std::string answers;
  bool json = false;
};

const SealedSet& set_of(const std::vector<SealedSet>& sets, const std::string& name, const std::string& folder) {
  const auto at = std::find_if(sets.begin(), sets.end(), [&](const SealedSet& set) { return set.name == name; });
  if (at != sets.end()) return *at;
  throw Error(fmt::format("{}: expected the folder of a set, {} to {}, found {}.", folder, sets.front().name,
                          sets.back().name, in_quotes(name)));
}

void make_run(const BlindRunOptions& options) {
  const fs::path set_folder = (fs::path(options.set) / "").lexically_normal().parent_path();  // no trailing slash
  const fs::path folder = set_folder.has_parent_path() ? set_folder.parent_path() : fs::path(".");
  const std::uint64_t number = next_number(set_folder);
  const fs::path out = options.out.empty() ? set_folder / fmt::format("run{}.csv", number) : fs::path(options.out);
  std::error_code ignored;
  if (fs::exists(out, ignored)) throw Error(fmt::format("{}: expected a new file, found one.", out.string()));
  const Schedule schedule = read_schedule_csv(read_bytes(options.schedule, kLargestText), options.schedule);
  if (duration_s(schedule) < schedule.reading_s) {
    throw Error(
        fmt::format("{}: expected a schedule at least as long as from reading to reading, {:g} s, found {:g} s.",
                    options.schedule, schedule.reading_s, duration_s(schedule)));
  }
  const fs::path answers = options.answers.empty() ? folder / "answers.json" : fs::path(options.answers);
  const std::vector<SealedSet> sets = read_blind(folder, answers);
  const SealedSet& set = set_of(sets, set_folder.filename().string(), folder.string());
  const Series run = run_of_set(folder, set, schedule, number);
  write_bytes(out, "# # SIMULATED by ballbar blind run, not measured.\n" + write_series(run));
  const double hours = duration_s(schedule) / 3600.0;
  if (options.json) {
    print_json(json_of(NextRun{out.string(), number, run.time_s.size(), hours}));
    return;
  }
  fmt::print("written  {}: {} rows over {:.4g} h, simulated\n", out.string(), run.time_s.size(), hours);
}

}  // namespace

void add_blind_run(CLI::App& blind) {
  const auto options = std::make_shared<BlindRunOptions>();
  CLI::App* command = blind.add_subcommand("run", "The machine of a set once more, under a schedule");
  command->add_option("SET", options->set, "folder of a set that blind make wrote: DIR/01")->required()->type_name("");
  command->add_option("--schedule", options->schedule, "schedule.csv: what the machine is to do")
      ->type_name("FILE")
      ->required();
  command->add_option("--out", options->out, "file for the run, new; without it SET/run2.csv, run3.csv ...")
      ->check(name_that_ends_in({".csv"}))
      ->type_name("FILE");
  command->add_option("--answers", options->answers, "file of the answers; without it DIR/answers.json")
      ->type_name("FILE");
  command->add_flag("--json", options->json, "the result for a program");
  command->footer(
      "Example:\n"
      "  ballbar blind make --n 20 --out blind-test\n"
      "  ballbar blind run blind-test/01 --schedule schedule.csv\n"
      "  ballbar blind score blind-test");
  command->callback([options] { make_run(*options); });
}

}  // namespace ballbar::commands
