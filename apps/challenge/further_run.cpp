// What a set's machine does under a schedule, its answers untold.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "ballbar/error.hpp"
#include "ballbar/formats/schedules/schedule_csv.hpp"
#include "ballbar/formats/series/series_csv.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "ballbar/nearest_name.hpp"
#include "challenge/blind_results.hpp"
#include "challenge/challenge.hpp"
#include "challenge/challenge_runs.hpp"
#include "terminal/caller.hpp"

namespace ballbar::commands {
namespace {

namespace fs = std::filesystem;

const SealedSet& set_of(const std::vector<SealedSet>& sets, const std::string& name, const std::string& folder) {
  const auto at = std::find_if(sets.begin(), sets.end(), [&](const SealedSet& set) { return set.name == name; });
  if (at != sets.end()) return *at;
  throw Error(fmt::format("{}: expected the folder of a set, {} to {}, found {}.", folder, sets.front().name,
                          sets.back().name, in_quotes(name)));
}

}  // namespace

void make_further_run(const FurtherRunOptions& options) {
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
  const std::vector<SealedSet> sets = read_blind(folder, answers_file(folder, options.answers));
  const SealedSet& set = set_of(sets, set_folder.filename().string(), folder.string());
  const Series run = run_of_set(folder, set, schedule, number);
  write_bytes(out, "# # SIMULATED by ballbar simulate, not measured.\n" + write_series(run));
  const double hours = duration_s(schedule) / 3600.0;
  if (options.json) {
    print_json(json_of(NextRun{out.string(), number, run.time_s.size(), hours}));
    return;
  }
  fmt::print("written  {}: {} rows over {:.4g} h, simulated\n", out.string(), run.time_s.size(), hours);
}

}  // namespace ballbar::commands
