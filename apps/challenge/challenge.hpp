// Blind tests with hidden effects in simulated data: `ballbar simulate --hidden`, further runs of such a machine, and
// the score.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace CLI {
class App;
}

namespace ballbar::commands {

inline constexpr int kMostSets = 500;

struct HiddenSetsOptions {
  int count = 20;
  std::string out;
  std::string answers;  // file; empty: in `out`
  std::optional<std::int64_t> seed;
  bool json = false;
};

// Writes the sets and their sealed answers, and prints the paths. Throws Error if `out` is not empty.
void make_hidden_sets(const HiddenSetsOptions& options);

struct FurtherRunOptions {
  std::string set;  // folder of a set
  std::string schedule;
  std::string out;      // .csv; empty: run2.csv, run3.csv ... in the set
  std::string answers;  // file; empty: beside the set
  bool json = false;
};

// Runs the machine of a set again with a schedule. Throws Error if `out` exists or the answers differ from the sealed
// ones.
void make_further_run(const FurtherRunOptions& options);

void add_score(CLI::App& simulate);

// answers.json of the folder, where no other file is named.
std::filesystem::path answers_file(const std::filesystem::path& folder, const std::string& answers);

// Of a work on many sets.
void show_sets(std::string_view what, std::size_t done, std::size_t of);

}  // namespace ballbar::commands
