// The files of data sets with hidden effects, on which a diagnosis is tested:
//
//   DIR/01/data.csv, model.toml   the data and the model to start from, set after set
//   DIR/README.txt                what to do
//   DIR/answers.json              {"format": "ballbar-hidden 1", "seed": 40, "sets": [...]}: the truth of every set
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "simulate/simulate_result.hpp"

namespace CLI {
class App;
}

namespace ballbar {

inline constexpr int kMostSets = 500;

std::filesystem::path answers_file(const std::filesystem::path& folder);

// Makes the sets and writes them, all or nothing. Throws Error where `folder` holds anything.
void write_hidden_sets(const std::filesystem::path& folder, std::size_t count, std::uint64_t seed);

// Name and answer of each set; nothing is said of them yet. Throws Error.
std::vector<ScoredSet> read_answers(const std::filesystem::path& folder);

// Of a work on many sets.
void show_sets(std::string_view what, std::size_t done, std::size_t of);

namespace commands {
void add_score(CLI::App& simulate);
}

}  // namespace ballbar
