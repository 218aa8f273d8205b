#include "challenge/challenge_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <functional>
#include <nlohmann/json.hpp>
#include <random>
#include <system_error>

#include "ballbar/error.hpp"
#include "ballbar/formats/models/model_toml.hpp"
#include "ballbar/formats/series/series_csv.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "ballbar/formats/text/new_folder.hpp"
#include "ballbar/nearest_name.hpp"
#include "challenge/digest.hpp"

namespace ballbar {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::string_view kFormat = "ballbar-blind 1";
constexpr std::size_t kDigits = 64;

constexpr std::string_view kReadme =
    R"(SIMULATED data, not measured: a blind test of a diagnosis, made by ballbar simulate --hidden.

Each numbered folder holds a series (data.csv) and the model that its user believes (model.toml). In
some of them one or two physical effects are hidden that the model lacks, in some there is something
that no catalogue has, in some the data cannot tell what it is, and in some there is nothing.

Look at each, for example:
  ballbar check 01/data.csv --model 01/model.toml
  ballbar effects
and write down what you think in a file verdicts.csv:
  set,verdict,effects
  01,named,lagged_expansion:temperature=T_room_degC
  02,nothing,
  03,equivalent,expansion:temperature=T_head_degC;lagged_expansion:temperature=T_head_degC
The verdicts are named, equivalent (one of these, the data cannot tell which), unexplained (something,
none of the catalogue), untestable, nothing. Two missing effects are both named, with ; between them.

Then, in the folder above this one, with the name of this one for DIR:
  ballbar simulate score DIR --by-hand verdicts.csv    your score
  ballbar simulate score DIR                           the program's own
The answers are sealed: SEAL holds the SHA-256 of their file, and they hold that of every data.csv and
model.toml. A score is refused where either has been changed.
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

// That of each set.
std::mt19937_64 seeds_of(std::uint64_t seed) {
  std::seed_seq words{static_cast<std::uint32_t>(seed & 0xffffffffU), static_cast<std::uint32_t>(seed >> 32)};
  return std::mt19937_64(words);
}

// The phrase of an Error is what was found.
SealedSet sealed_set(const Json& json) {
  SealedSet set;
  set.name = json.at("set").get<std::string>();
  const bool is_number = !set.name.empty() && set.name.size() < 6 &&
                         std::all_of(set.name.begin(), set.name.end(),
                                     [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; });
  if (!is_number) throw Error(fmt::format("a set called {}", in_quotes(set.name)));
  const std::string kind = json.at("kind").get<std::string>();
  const std::optional<BlindKind> known = blind_kind_from_name(kind);
  if (!known) throw Error(fmt::format("a kind {}", in_quotes(kind)));
  set.answer.kind = *known;
  set.answer.what = json.at("what").get<std::string>();
  set.answer.hidden = bounds_of(json.at("hidden"));
  set.answer.match = bounds_of(json.at("match"));
  set.answer.d = json.at("d").get<std::vector<double>>();
  set.answer.amplitude_um = json.at("amplitude_um").get<std::vector<double>>();
  set.data_sha256 = json.at("data_sha256").get<std::string>();
  set.model_sha256 = json.at("model_sha256").get<std::string>();
  return set;
}

std::vector<SealedSet> answers_of(const std::string& bytes, const fs::path& file) {
  std::string found;
  try {
    const Json outer = Json::parse(bytes);
    if (outer.at("format").get<std::string>() != kFormat) throw Error("another format");
    const std::optional<std::string> inner = from_base64(outer.at("answers").get<std::string>());
    if (!inner) throw Error("answers that are not base64");
    std::vector<SealedSet> sets;
    const Json answers = Json::parse(*inner);
    for (const Json& json : answers.at("sets")) sets.push_back(sealed_set(json));
    if (sets.empty()) throw Error("no set");
    std::mt19937_64 seeds = seeds_of(answers.at("seed").get<std::uint64_t>());
    const std::string machine_sha256 = answers.value("machine_sha256", std::string());
    for (SealedSet& set : sets) {
      set.seed = seeds();
      set.machine_sha256 = machine_sha256;
    }
    return sets;
  } catch (const nlohmann::json::exception&) {
    found = "something else";
  } catch (const Error& error) {
    found = error.what();
  }
  throw Error(
      fmt::format("{}: expected answers of ballbar simulate --hidden ({}), found {}.", file.string(), kFormat, found));
}

void expect_made(const fs::path& file, std::size_t limit, const std::string& digest) {
  if (sha256(read_bytes(file, limit)) == digest) return;
  throw Error(fmt::format("{}: expected the original file (SHA-256 {:.12}...), found another.", file.string(), digest));
}

void expect_new(const fs::path& folder, const fs::path& answers) {
  expect_new_folder(folder);
  std::error_code error;
  if (fs::exists(answers, error)) {
    throw Error(fmt::format("{}: expected a new file for the answers, found one.", answers.string()));
  }
}

std::string label(std::size_t index, std::size_t count) { return fmt::format("{:0{}}", index + 1, count > 99 ? 3 : 2); }

}  // namespace

// The name of the command is that of the format: digests of sets that were made before hold it.
std::string data_of(const BlindSet& set) {
  return "# # SIMULATED by ballbar blind make, not measured.\n" + write_series(set.data);
}

std::string write_blind(const fs::path& folder, const fs::path& answers, std::size_t count, std::uint64_t seed,
                        const std::function<void(std::size_t)>& progress) {
  expect_seal();
  const fs::path target = folder_to_write(folder);
  expect_new(folder, answers);
  const bool is_elsewhere = fs::absolute(answers).lexically_normal() != target / "answers.json";
  const fs::path temporary = new_folder_beside(target);
  std::string digest;
  std::error_code ignored;
  bool answers_written = false;
  try {
    std::mt19937_64 seeds = seeds_of(seed);
    Json sets = Json::array();
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint64_t own = seeds();
      const BlindSet set = blind_set(blind_kind(own), own);
      const std::string name = label(i, count);
      const std::string data = data_of(set);
      const std::string model = write_model(set.model);
      fs::create_directory(temporary / name);
      write_bytes(temporary / name / "data.csv", data);
      write_bytes(temporary / name / "model.toml", model);
      sets.push_back({{"set", name},
                      {"kind", name_of(set.answer.kind)},
                      {"what", set.answer.what},
                      {"hidden", json_of(set.answer.hidden)},
                      {"match", json_of(set.answer.match)},
                      {"d", set.answer.d},
                      {"amplitude_um", set.answer.amplitude_um},
                      {"data_sha256", sha256(data)},
                      {"model_sha256", sha256(model)}});
      progress(i + 1);
    }
    const Json inner = {{"seed", seed}, {"sets", sets}};
    const Json outer = {{"format", kFormat}, {"answers", base64(inner.dump())}};
    const std::string bytes = outer.dump(2) + "\n";
    digest = sha256(bytes);
    write_bytes(temporary / "README.txt", kReadme);
    write_bytes(temporary / "SEAL", fmt::format("{}  {}\n", digest, answers.filename().string()));
    if (is_elsewhere) {
      write_bytes(answers, bytes);
      answers_written = true;
    } else {
      write_bytes(temporary / "answers.json", bytes);
    }
    fs::remove(target);  // an empty one
    fs::rename(temporary, target);
  } catch (const fs::filesystem_error& failed) {
    fs::remove_all(temporary, ignored);
    if (answers_written) fs::remove(answers, ignored);
    throw Error(fmt::format("{}: expected a folder to write to, found: {}.", folder.string(), failed.code().message()));
  } catch (...) {
    fs::remove_all(temporary, ignored);
    if (answers_written) fs::remove(answers, ignored);
    throw;
  }
  return digest;
}

std::vector<SealedSet> read_blind(const fs::path& folder, const fs::path& answers) {
  expect_seal();
  const std::string bytes = read_bytes(answers, kLargestText);
  const fs::path seal_file = folder / "SEAL";
  const std::string seal = read_bytes(seal_file, kLargestText);
  const std::string sealed = seal.substr(0, std::min(seal.find_first_of(" \r\n"), seal.size()));
  const bool is_digest = sealed.size() == kDigits && std::all_of(sealed.begin(), sealed.end(), [](char c) {
                           return std::isxdigit(static_cast<unsigned char>(c)) != 0;
                         });
  if (!is_digest) {
    throw Error(fmt::format("{}: expected the SHA-256 of the answers, {} hexadecimal digits, found {}.",
                            seal_file.string(), kDigits, in_quotes(sealed)));
  }
  const std::string digest = sha256(bytes);
  if (digest != sealed) {
    throw Error(fmt::format("{}: expected the answers that were sealed (SHA-256 {:.12}...), found others ({:.12}...).",
                            answers.string(), sealed, digest));
  }
  std::vector<SealedSet> sets = answers_of(bytes, answers);
  for (const SealedSet& set : sets) {
    expect_made(folder / set.name / "data.csv", kLargestTable, set.data_sha256);
    expect_made(folder / set.name / "model.toml", kLargestText, set.model_sha256);
  }
  return sets;
}

}  // namespace ballbar
