// A file that lists the runs of one machine, such as `machine.toml`.
//
//   format = "ballbar-runs 1"
//   title = "spindle 2"
//   [[run]]
//   file = "monday.csv"
//   [[run]]
//   file = "tuesday"      # a session
//   starts = "warm"
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/formats/text/reader.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

struct RunOfMachine {
  std::string file;               // a series or a session, inside the folder of the list
  std::optional<RunStart> start;  // nullopt: derived from the clocks and the first speed
};

struct RunsOfMachine {
  std::string title;
  std::vector<RunOfMachine> runs;  // at least one, at most 1000
};

// `name` is used in messages. Throws Error with name:line:column.
RunsOfMachine read_run_list(std::string_view bytes, std::string_view name);

// Whether the file is such a list.
bool lists_runs(const Source& source, std::span<const Reader> readers = known_readers());

}  // namespace ballbar
