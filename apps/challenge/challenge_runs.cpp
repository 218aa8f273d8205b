#include "challenge/challenge_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <system_error>

#include "ballbar/error.hpp"
#include "ballbar/formats/machines/machine_toml.hpp"
#include "ballbar/formats/series/series_csv.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "challenge/digest.hpp"

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

}  // namespace

std::vector<fs::path> runs_of_set(const fs::path& set_folder) {
  std::vector<fs::path> runs;
  for (const auto& [number, file] : numbered(set_folder)) runs.push_back(file);
  return runs;
}

std::uint64_t next_number(const fs::path& set_folder) { return numbered(set_folder).rbegin()->first + 1; }

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

}  // namespace ballbar
