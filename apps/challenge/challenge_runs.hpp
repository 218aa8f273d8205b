// Further runs of a set's machine, beside its data: run2.csv, run3.csv ...
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "ballbar/diagnosis/next_test/schedule.hpp"
#include "ballbar/series/series.hpp"
#include "challenge/challenge_files.hpp"

namespace ballbar {

// data.csv of that folder, which need not be there, and what runs it has in their order.
std::vector<std::filesystem::path> runs_of_set(const std::filesystem::path& set_folder);

// The number of the next one: 2 where there is only data.csv.
std::uint64_t next_number(const std::filesystem::path& set_folder);

// The set's machine under that schedule. `folder` is that of all sets. Throws Error where another version of ballbar
// made the set, whose truth cannot be drawn again, and where the sealed machine is another.
Series run_of_set(const std::filesystem::path& folder, const SealedSet& set, const Schedule& schedule,
                  std::uint64_t number);

}  // namespace ballbar
