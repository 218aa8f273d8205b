// The files of a blind test: data sets with hidden effects, and the sealed answers.
//
//   DIR/01/data.csv, model.toml   the data and the model to start from, set after set
//   DIR/README.txt                what to do
//   DIR/SEAL                      "SHA256  answers.json", as sha256sum writes it: the digest of the answers
//   DIR/answers.json              {"format": "ballbar-blind 1", "answers": BASE64}; in it the truth of every set and
//                                 the digests of its files. May be kept elsewhere
// Anyone with the file of answers can read it. The seal shows that answers and data are unchanged; it does not encrypt.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/lab/challenge/blind.hpp"

namespace ballbar {

struct SealedSet {
  std::string name;  // its folder: "01"
  BlindAnswer answer;
  std::string data_sha256, model_sha256;
  std::uint64_t seed = 0;      // of blind_set
  std::string machine_sha256;  // of DIR/machine.toml.base64, which replaces the machine of a blind set; empty: none
};

// data.csv of a set.
std::string data_of(const BlindSet& set);

// Makes the sets and writes them, all or nothing; returns the digest of the answers. `progress` is called with the
// number of sets that are made. Throws Error where `folder` holds anything or `answers` exists.
std::string write_blind(const std::filesystem::path& folder, const std::filesystem::path& answers, std::size_t count,
                        std::uint64_t seed, const std::function<void(std::size_t)>& progress);

// Throws Error: no answers or no SEAL; answers, data or a model that differ from the sealed ones.
std::vector<SealedSet> read_blind(const std::filesystem::path& folder, const std::filesystem::path& answers);

// data.csv of the folder of a set, which need not exist, and its further runs run2.csv, run3.csv ... in order.
std::vector<std::filesystem::path> runs_of_set(const std::filesystem::path& set_folder);

// Verdicts of a person, one line per set, with the header `set,verdict,effects`. Effects are written as on the command
// line, joined by ";": for `named` all missing effects, for `equivalent` the alternatives, none for other verdicts.
// Throws Error "name:line: ..." for anything else, and for an unknown, missing or repeated set. In the order of `sets`.
std::vector<BlindVerdict> read_verdicts(std::string_view bytes, std::string_view name,
                                        const std::vector<SealedSet>& sets);

}  // namespace ballbar
