#include "simulate/hidden_sets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <utility>

#include "ballbar/error.hpp"
#include "ballbar/formats/models/model_toml.hpp"
#include "ballbar/formats/series/series_csv.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "ballbar/formats/text/new_folder.hpp"
#include "ballbar/internal/nearest_name.hpp"
#include "terminal/stderr_line.hpp"

namespace ballbar {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::string_view kFormat = "ballbar-hidden 1";

constexpr std::string_view kSimulated = "# # SIMULATED by ballbar simulate --hidden, not measured.\n";

constexpr std::string_view kReadme =
    R"(SIMULATED data, not measured: a test of a diagnosis, made by ballbar simulate --hidden.

Each numbered folder holds a series (data.csv) and the model that its user believes (model.toml). In
some of them one or two physical effects are hidden that the model lacks, in some there is something
that no catalogue has, in some the data cannot tell what it is, and in some there is nothing.

Look at each, for example:
  ballbar check 01/data.csv --model 01/model.toml
  ballbar diagnose 01/data.csv --model 01/model.toml
The truth of every set is in answers.json: open it when you have written down what you think.

In the folder above this one, with the name of this one for DIR, the program's diagnoses are compared
with the answers by
  ballbar simulate score DIR
)";

Json json_of(const std::vector<BoundEffect>& bounds) {
  Json list = Json::array();
  for (const BoundEffect& bound : bounds) {
    list.push_back({{"effect", bound.effect->name}, {"columns", bound.columns}});
  }
  return list;
}

std::vector<BoundEffect> bounds_of(const Json& list) {
  std::vector<BoundEffect> bounds;
  for (const Json& one : list) {
    BoundEffect bound{find_effect(one.at("effect").get<std::string>(), Level::series), {}};
    if (bound.effect == nullptr) throw Error("an effect that is not in the catalogue");
    bound.columns = one.at("columns").get<std::vector<std::string>>();
    bounds.push_back(std::move(bound));
  }
  return bounds;
}

// The phrase of an Error is what was found.
ScoredSet answered_set(const Json& json) {
  ScoredSet set;
  set.name = json.at("set").get<std::string>();
  const bool is_number = !set.name.empty() && set.name.size() < 6 &&
                         std::all_of(set.name.begin(), set.name.end(),
                                     [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; });
  if (!is_number) throw Error(fmt::format("a set called {}", in_quotes(set.name)));
  const std::string kind = json.at("kind").get<std::string>();
  const std::optional<BlindKind> known = blind_kind_from_name(kind);
  if (!known) throw Error(fmt::format("a kind {}", in_quotes(kind)));
  set.answer.kind = *known;
  set.answer.what = json.at("truth").get<std::string>();
  set.answer.hidden = bounds_of(json.at("hidden"));
  set.answer.match = bounds_of(json.at("match"));
  set.answer.d = json.at("d").get<std::vector<double>>();
  set.answer.amplitude_um = json.at("amplitude_um").get<std::vector<double>>();
  return set;
}

}  // namespace

void show_sets(std::string_view what, std::size_t done, std::size_t of) {
  show_progress(done == of ? "" : fmt::format("{} {} of {}", what, done, of));
}

fs::path answers_file(const fs::path& folder) { return folder / "answers.json"; }

void write_hidden_sets(const fs::path& folder, std::size_t count, std::uint64_t seed) {
  expect_new_folder(folder);
  std::seed_seq words{static_cast<std::uint32_t>(seed & 0xffffffffU), static_cast<std::uint32_t>(seed >> 32)};
  std::mt19937_64 seeds(words);  // that of each set
  std::vector<std::pair<std::string, std::string>> files{{"README.txt", std::string(kReadme)}};
  Json sets = Json::array();
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint64_t own = seeds();
    const BlindSet set = blind_set(blind_kind(own), own);
    const std::string name = fmt::format("{:0{}}", i + 1, count > 99 ? 3 : 2);
    files.emplace_back(name + "/data.csv", std::string(kSimulated) + write_series(set.data));
    files.emplace_back(name + "/model.toml", write_model(set.model));
    sets.push_back({{"set", name},
                    {"kind", name_of(set.answer.kind)},
                    {"truth", set.answer.what},
                    {"hidden", json_of(set.answer.hidden)},
                    {"match", json_of(set.answer.match)},
                    {"d", set.answer.d},
                    {"amplitude_um", set.answer.amplitude_um}});
    show_sets("making set", i + 1, count);
  }
  files.emplace_back("answers.json", Json{{"format", kFormat}, {"seed", seed}, {"sets", sets}}.dump(2) + "\n");
  write_folder(folder, files);
}

std::vector<ScoredSet> read_answers(const fs::path& folder) {
  const fs::path file = answers_file(folder);
  const std::string bytes = read_bytes(file, kLargestText);
  std::string found;
  try {
    const Json answers = Json::parse(bytes);
    if (answers.at("format").get<std::string>() != kFormat) throw Error("another format");
    std::vector<ScoredSet> sets;
    for (const Json& json : answers.at("sets")) sets.push_back(answered_set(json));
    if (sets.empty()) throw Error("no set");
    return sets;
  } catch (const nlohmann::json::exception&) {
    found = "something else";
  } catch (const Error& error) {
    found = error.what();
  }
  throw Error(
      fmt::format("{}: expected answers of ballbar simulate --hidden ({}), found {}.", file.string(), kFormat, found));
}

}  // namespace ballbar
