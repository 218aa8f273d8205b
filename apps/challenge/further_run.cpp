// What a set's machine does under a schedule, its answers untold: run2.csv, run3.csv ... beside its data.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

#include "ballbar/error.hpp"
#include "ballbar/formats/machines/machine_toml.hpp"
#include "ballbar/formats/schedules/schedule_csv.hpp"
#include "ballbar/formats/series/series_csv.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "ballbar/nearest_name.hpp"
#include "challenge/blind_results.hpp"
#include "challenge/challenge.hpp"
#include "challenge/challenge_files.hpp"
#include "challenge/digest.hpp"
#include "terminal/caller.hpp"

namespace ballbar {
namespace {

namespace fs = std::filesystem;

// Of runN.csv, N from 2 on; 0: another file.
std::uint64_t number_of_run(const std::string& name) {
  constexpr std::string_view kBefore = "run", kAfter = ".csv";
  if (!name.starts_with(kBefore) || !name.ends_with(kAfter) || name.size() <= kBefore.size() + kAfter.size()) return 0;
  const char* const begin = name.data() + kBefore.size();
  const char* const end = name.data() + name.size() - kAfter.size();
  std::uint64_t number = 0;
  const auto [read, error] = std::from_chars(begin, end, number);
  return error == std::errc() && read == end && *begin != '0' && number > 1 ? number : 0;
}

std::map<std::uint64_t, fs::path> numbered(const fs::path& set_folder) {
  std::map<std::uint64_t, fs::path> runs{{1, set_folder / "data.csv"}};
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(set_folder, ignored)) {
    const std::uint64_t number = number_of_run(entry.path().filename().string());
    if (number > 0) runs[number] = entry.path();
  }
  return runs;
}

VirtualSpindle sealed_machine(const fs::path& file, const std::string& digest) {
  std::string coded = read_bytes(file, kLargestText);
  std::erase_if(coded, [](char c) { return c == '\n' || c == '\r'; });
  const std::optional<std::string> bytes = from_base64(coded);
  if (!bytes || sha256(*bytes) != digest) {
    throw Error(fmt::format("{}: expected the machine that was sealed (SHA-256 {:.12}...), found another.",
                            file.string(), digest));
  }
  const VirtualMachine machine = read_machine(*bytes, file.string());
  if (!machine.spindle) throw Error(fmt::format("{}: expected a machine with a spindle, found none.", file.string()));
  return *machine.spindle;
}

// The set's machine under that schedule. `folder` is that of all sets. Throws Error where another version of ballbar
// made the set, whose truth cannot be drawn again, and where the sealed machine is another.
Series run_of_set(const fs::path& folder, const SealedSet& set, const Schedule& schedule, std::uint64_t number) {
  if (!set.machine_sha256.empty()) {
    return next_run(sealed_machine(folder / "machine.toml.base64", set.machine_sha256), schedule, set.seed, number);
  }
  if (sha256(data_of(blind_set(set.answer.kind, set.seed))) != set.data_sha256) {
    throw Error(fmt::format("{}: expected a set that this ballbar draws alike, found one of another version.",
                            (folder / set.name / "data.csv").string()));
  }
  return next_run(set.answer.kind, set.seed, schedule, number);
}

const SealedSet& set_of(const std::vector<SealedSet>& sets, const std::string& name, const std::string& folder) {
  const auto at = std::find_if(sets.begin(), sets.end(), [&](const SealedSet& set) { return set.name == name; });
  if (at != sets.end()) return *at;
  throw Error(fmt::format("{}: expected the folder of a set, {} to {}, found {}.", folder, sets.front().name,
                          sets.back().name, in_quotes(name)));
}

}  // namespace

std::vector<fs::path> runs_of_set(const fs::path& set_folder) {
  std::vector<fs::path> runs;
  for (const auto& [number, file] : numbered(set_folder)) runs.push_back(file);
  return runs;
}

void commands::make_further_run(const FurtherRunOptions& options) {
  const fs::path set_folder = (fs::path(options.set) / "").lexically_normal().parent_path();  // no trailing slash
  const fs::path folder = set_folder.has_parent_path() ? set_folder.parent_path() : fs::path(".");
  const std::uint64_t number = numbered(set_folder).rbegin()->first + 1;
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

}  // namespace ballbar
