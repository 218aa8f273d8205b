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
#include "ballbar/model/effect_argument.hpp"
#include "ballbar/nearest_name.hpp"
#include "challenge/digest.hpp"
#include "terminal/new_folder.hpp"

namespace ballbar {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::string_view kFormat = "ballbar-blind 1";
constexpr std::string_view kHeading = "set,verdict,effects";
constexpr std::size_t kDigits = 64;

constexpr std::string_view kReadme =
    R"(SIMULATED data, not measured: a blind test of a diagnosis, made by ballbar blind make.

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
  ballbar blind score DIR --by-hand verdicts.csv    your score
  ballbar blind score DIR                           the program's own
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
    return sets;
  } catch (const nlohmann::json::exception&) {
    found = "something else";
  } catch (const Error& error) {
    found = error.what();
  }
  throw Error(fmt::format("{}: expected answers of ballbar blind make ({}), found {}.", file.string(), kFormat, found));
}

void expect_made(const fs::path& file, std::size_t limit, const std::string& digest) {
  if (sha256(read_bytes(file, limit)) == digest) return;
  throw Error(
      fmt::format("{}: expected the file that was made (SHA-256 {:.12}...), found another.", file.string(), digest));
}

void expect_new(const fs::path& folder, const fs::path& answers) {
  expect_new_folder(folder);
  std::error_code error;
  if (fs::exists(answers, error)) {
    throw Error(fmt::format("{}: expected a new file for the answers, found one.", answers.string()));
  }
}

std::string label(std::size_t index, std::size_t count) { return fmt::format("{:0{}}", index + 1, count > 99 ? 3 : 2); }

std::vector<std::string_view> split(std::string_view text, char at, std::size_t most) {
  std::vector<std::string_view> parts;
  while (parts.size() + 1 < most) {
    const std::size_t end = text.find(at);
    if (end == std::string_view::npos) break;
    parts.push_back(text.substr(0, end));
    text.remove_prefix(end + 1);
  }
  parts.push_back(text);
  return parts;
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

// All columns or none: a set's own data are not asked which is meant.
BoundEffect bound_by_hand(std::string_view text) {
  const EffectText option = effect_text(text, Level::series);
  BoundEffect bound{option.effect, {}};
  for (const Input& input : option.effect->inputs) {
    for (const auto& [role, column] : option.columns) {
      if (role == input.role) bound.columns.push_back(column);
    }
  }
  if (!bound.columns.empty() && bound.columns.size() != option.effect->inputs.size()) {
    throw Error(fmt::format("expected all columns of {} or none, found {} of {}.", option.effect->name,
                            bound.columns.size(), option.effect->inputs.size()));
  }
  return bound;
}

BlindVerdict verdict_by_hand(std::string_view verdict, std::string_view effects) {
  BlindVerdict result;
  constexpr Verdict kVerdicts[] = {Verdict::named, Verdict::equivalent, Verdict::unexplained, Verdict::untestable,
                                   Verdict::nothing};
  const auto at =
      std::find_if(std::begin(kVerdicts), std::end(kVerdicts), [&](Verdict one) { return name_of(one) == verdict; });
  if (at == std::end(kVerdicts)) {
    throw Error(
        fmt::format("expected named, equivalent, unexplained, untestable or nothing, found {}.", in_quotes(verdict)));
  }
  result.verdict = *at;
  if (effects.size() > 1 && effects.front() == '"' && effects.back() == '"') {
    effects = trimmed(effects.substr(1, effects.size() - 2));
  }
  const bool has_effects = *at == Verdict::named || *at == Verdict::equivalent;
  if (has_effects == effects.empty()) {
    throw Error(has_effects ? fmt::format("expected effects behind {}, found none.", verdict)
                            : fmt::format("expected no effects behind {}, found {}.", verdict, in_quotes(effects)));
  }
  if (!has_effects) return result;
  std::vector<BoundEffect>& bounds = *at == Verdict::named ? result.named : result.reported;
  for (const std::string_view one : split(effects, ';', effects.size() + 1)) {
    bounds.push_back(bound_by_hand(trimmed(one)));
  }
  return result;
}

}  // namespace

std::string write_blind(const fs::path& folder, const fs::path& answers, std::size_t count, std::uint64_t seed,
                        const std::function<void(std::size_t)>& progress) {
  expect_seal();
  const fs::path target = folder_to_write(folder);
  expect_new(folder, answers);
  const bool apart = fs::absolute(answers).lexically_normal() != target / "answers.json";
  const fs::path temporary = new_folder_beside(target);
  std::string digest;
  std::error_code ignored;
  bool answers_written = false;
  try {
    std::seed_seq words{static_cast<std::uint32_t>(seed & 0xffffffffU), static_cast<std::uint32_t>(seed >> 32)};
    std::mt19937_64 seeds(words);
    Json sets = Json::array();
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint64_t own = seeds();
      const BlindSet set = blind_set(blind_kind(own), own);
      const std::string name = label(i, count);
      const std::string data = "# # SIMULATED by ballbar blind make, not measured.\n" + write_series(set.data);
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
    if (apart) {
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

std::vector<BlindVerdict> read_verdicts(std::string_view bytes, std::string_view name,
                                        const std::vector<SealedSet>& sets) {
  if (bytes.starts_with("\xef\xbb\xbf")) bytes.remove_prefix(3);
  std::vector<std::optional<BlindVerdict>> verdicts(sets.size());
  std::size_t number = 0;
  bool has_heading = false;
  const auto fail = [&](const std::string& sentence) { throw Error(fmt::format("{}:{}: {}", name, number, sentence)); };
  for (const std::string_view whole : split(bytes, '\n', bytes.size() + 1)) {
    ++number;
    const std::string_view line = trimmed(whole);
    if (line.empty() || line.front() == '#') continue;
    if (!has_heading) {
      if (line != kHeading) fail(fmt::format("expected the heading {}, found {}.", kHeading, in_quotes(line)));
      has_heading = true;
      continue;
    }
    const std::vector<std::string_view> cells = split(line, ',', 3);
    if (cells.size() < 2) fail(fmt::format("expected set,verdict,effects, found {}.", in_quotes(line)));
    const auto at =
        std::find_if(sets.begin(), sets.end(), [&](const SealedSet& set) { return set.name == trimmed(cells[0]); });
    if (at == sets.end()) {
      fail(fmt::format("expected a set from {} to {}, found {}.", sets.front().name, sets.back().name,
                       in_quotes(trimmed(cells[0]))));
    }
    std::optional<BlindVerdict>& verdict = verdicts[static_cast<std::size_t>(at - sets.begin())];
    if (verdict) fail(fmt::format("expected each set once, found {} again.", at->name));
    try {
      verdict = verdict_by_hand(trimmed(cells[1]), cells.size() > 2 ? trimmed(cells[2]) : std::string_view());
    } catch (const Error& error) {
      fail(error.what());
    }
  }
  std::vector<BlindVerdict> result;
  for (std::size_t i = 0; i < sets.size(); ++i) {
    if (!verdicts[i]) {
      throw Error(fmt::format("{}: expected a verdict for each of {} sets, found none for {}.", name, sets.size(),
                              sets[i].name));
    }
    result.push_back(std::move(*verdicts[i]));
  }
  return result;
}

}  // namespace ballbar
