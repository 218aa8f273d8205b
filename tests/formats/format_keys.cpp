// Holds the tables of keys of formats/README.md to the lists by which the readers know them. A table stands between
// the lines `<!-- keys of NAME -->` and `<!-- end of keys -->`. And the defaults that the tables of machine.toml state
// to those that hold: a machine that states them is the same as one that leaves them out.
//
//   format_keys PAGE [--update]     --update rewrites the tables that differ
#include <fmt/core.h>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/formats/text/file_bytes.hpp"
#include "ballbar/formats/text/keys.hpp"
#include "ballbar/lab/spindle/finite_volume_spindle.hpp"
#include "simulate/fleet_toml.hpp"
#include "simulate/machine_toml.hpp"
#include "simulate/shaft_images.hpp"
#include "simulate/simulated_files.hpp"

namespace ballbar {
namespace {

std::string table_text(const KeyTable& table) {
  std::size_t names = 3, kinds = 5;
  for (const Key& key : table.keys) {
    names = std::max(names, key.name.size() + 2);
    kinds = std::max(kinds, key.holds.size());
  }
  std::string out = table.table.empty() ? "\n" : fmt::format("\n{}\n\n", table.table);
  out += fmt::format("| {:<{}} | {:<{}} | meaning |\n|{:-<{}}|{:-<{}}|---|\n", "key", names, "holds", kinds, "",
                     names + 2, "", kinds + 2);
  for (const Key& key : table.keys) {
    out +=
        fmt::format("| {:<{}} | {:<{}} | {} |\n", fmt::format("`{}`", key.name), names, key.holds, kinds, key.meaning);
  }
  return out;
}

std::string text_of(const std::vector<KeyTable>& tables) {
  std::string out;
  for (const KeyTable& table : tables) out += table_text(table);
  return out + '\n';
}

// With their defaults; there are too many for a table.
std::string body_text() {
  const FiniteVolumeSpindle body;
  std::string out = "\n`[spindle.body]`, with the defaults:\n", line;
  for (const SpindleParameter& parameter : spindle_parameters()) {
    const bool last = parameter.member == spindle_parameters().back().member;
    const std::string one = fmt::format("`{}` {}{}", parameter.name, body.*parameter.member, last ? "." : ",");
    if (line.size() + 1 + one.size() > 120) {
      out += line + '\n';
      line.clear();
    }
    line += (line.empty() ? "" : " ") + one;
  }
  return out + line + "\n\n";
}

std::string keys_text(std::string_view name) {
  if (name == "session.toml") return text_of(session_keys());
  if (name == "runs") return text_of(runs_keys());
  if (name == "ballbar log") return text_of(log_keys());
  if (name == "b5r") return text_of(b5r_keys());
  if (name == "series") return text_of(series_keys());
  if (name == "recipe") return text_of(recipe_keys());
  if (name == "model .toml") return text_of(model_keys());
  if (name == "history") return text_of(history_keys());
  if (name == "machine.toml") return text_of(machine_keys());
  if (name == "spindle") return text_of(spindle_keys());
  if (name == "spindle body") return body_text();
  if (name == "spindle image") return text_of(image_keys());
  if (name == "fleet.toml") return text_of(fleet_keys());
  return "";
}

// Lines `key = value` of the defaults that a table states: `default 0.2`, `"jet", the default`.
std::string defaults_of(std::span<const Key> keys, const std::set<std::string_view>& but = {}) {
  static const std::regex stated(R"re((?:.*default |)(true|false|"\w+"|-?[0-9.]*[0-9])(?:, the default.*|[;.].*|$))re");
  std::string out;
  for (const Key& key : keys) {
    std::cmatch found;
    if (key.meaning.find("default") == std::string_view::npos || but.contains(key.name)) continue;
    if (std::regex_match(key.meaning.data(), key.meaning.data() + key.meaning.size(), found, stated)) {
      out += fmt::format("{} = {}\n", key.name, found[1].str());
    }
  }
  return out;
}

// Of the arcs and the circle, which stand in the file's own table.
std::string default_sweeps() {
  static const std::regex stated(R"re(.*default (-?\d+) to (\d+) deg, (\d+) readings)re");
  std::string out;
  const std::vector<KeyTable> tables = machine_keys();
  for (const Key& key : tables.front().keys) {
    std::cmatch found;
    if (!std::regex_match(key.meaning.data(), key.meaning.data() + key.meaning.size(), found, stated)) continue;
    out += fmt::format("[{}]\nstart_deg = {}\nend_deg = {}\nreadings = {}\n", key.name, found[1].str(), found[2].str(),
                       found[3].str());
  }
  return out;
}

std::string made_by(const std::string& machine) {
  std::string out;
  for (const SimulatedFile& file : simulated_files(simulate(read_machine(machine, "machine.toml")), false)) {
    out += file.name + '\n' + file.bytes;
  }
  return out;
}

// A machine of that method with these keys of its own; with the stated defaults or without.
std::string machine_text(const std::string& method, const std::string& axial, bool stated) {
  std::map<std::string, std::string> own{{"[axial]", axial},
                                         {"[five_probe]", ""},
                                         {"[[signal]]", "name = \"T_a_degC\"\ntime_min = [0, 10]\nvalue = [20, 21]\n"}};
  std::string out = "format = \"ballbar-machine 1\"\ntest_min = [0, 10]\nstarted = 2024-03-04T08:00:00\n" + method;
  if (stated) out += defaults_of(machine_keys().front().keys, {method.empty() ? "" : "method"});
  std::string tables, sweeps = stated ? default_sweeps() : "";
  for (const KeyTable& table : machine_keys()) {
    std::string name(table.table);
    std::erase(name, '`');
    if (name.empty() || name.find("arc") != std::string::npos || name.find("truth") != std::string::npos) continue;
    if (name == "[circle]") {  // it follows its sweep, which is the last
      if (stated) sweeps += defaults_of(table.keys);
      continue;
    }
    const std::set<std::string_view> but{own[name].starts_with("readings") ? "readings" : ""};
    const std::string defaults = stated ? defaults_of(table.keys, but) : "";
    if (name == "[five_probe]" || !own[name].empty() || !defaults.empty()) tables += name + '\n' + own[name] + defaults;
  }
  return out + tables + sweeps;
}

bool defaults_hold() {
  bool hold = true;
  const auto expect_same = [&](const std::string& what, bool same) {
    if (!same) fmt::print("{}: the defaults that its tables state are not those that hold\n", what);
    hold = hold && same;
  };
  for (const std::string method : {"", "spindle_rotation", "circles"}) {
    const std::string line = method.empty() ? "" : fmt::format("method = \"{}\"\n", method);
    for (const std::string axial : {"", "readings = 3\n"}) {
      if (!axial.empty() && method != "spindle_rotation") continue;
      expect_same("machine.toml " + method,
                  made_by(machine_text(line, axial, false)) == made_by(machine_text(line, axial, true)));
    }
  }
  const std::string series =
      "format = \"ballbar-machine 1\"\nmethod = \"series\"\n[spindle]\ntime_min = [0]\nspeed_rpm = [9000]\nend_min = "
      "30\n";
  expect_same("[spindle]",
              made_by(series) == made_by(series + defaults_of(spindle_keys().front().keys) + "[spindle.measured]\n" +
                                         defaults_of(spindle_keys().back().keys)));
  const std::string image = series + "profile_min = [30]\n[[spindle.image]]\ntime_min = 30\nfile = \"a.jpg\"\n";
  const std::string stated = image + defaults_of(image_keys().front().keys);
  const ShaftImage without = read_shaft_images(image, "").front(), with = read_shaft_images(stated, "").front();
  const ShaftPictureStyle &a = without.style, &b = with.style;
  expect_same("[[spindle.image]]", without.quality == with.quality && a.colours == b.colours && a.legend == b.legend &&
                                       a.bands == b.bands && a.width_px == b.width_px && a.height_px == b.height_px);
  return hold;
}

constexpr std::string_view kBegin = "<!-- keys of ", kBeginEnd = " -->\n", kEnd = "<!-- end of keys -->";
constexpr std::size_t kTables = 13;

int held(const std::filesystem::path& path, bool update) {
  const std::string page = read_bytes(path, kLargestText);
  std::string out;
  std::set<std::string> seen;
  int wrong = 0;
  std::size_t at = 0;
  for (std::size_t begin; (begin = page.find(kBegin, at)) != std::string::npos;) {
    const std::size_t name_end = page.find(kBeginEnd, begin), end = page.find(kEnd, begin);
    if (name_end == std::string::npos || end == std::string::npos || end < name_end) {
      fmt::print("{}: a table of keys does not end\n", path.string());
      return 1;
    }
    const std::string name = page.substr(begin + kBegin.size(), name_end - begin - kBegin.size());
    const std::size_t body = name_end + kBeginEnd.size();
    const std::string expected = keys_text(name);
    if (expected.empty() || !seen.insert(name).second) {
      fmt::print("{}: there is no list of keys \"{}\", or it stands twice\n", path.string(), name);
      return 1;
    }
    if (page.substr(body, end - body) != expected) {
      ++wrong;
      fmt::print("{}: the keys of {} are not those of the reader, which are\n{}", path.string(), name, expected);
    }
    out += page.substr(at, body - at) + expected;
    at = end;
  }
  out += page.substr(at);
  fmt::print("{}: {} tables, {} differences\n", path.string(), seen.size(), wrong);
  if (seen.size() != kTables) {
    fmt::print("expected {} tables\n", kTables);
    return 1;
  }
  if (update && wrong > 0) write_bytes(path, out);
  return wrong > 0 && !update ? 1 : 0;
}

}  // namespace
}  // namespace ballbar

int main(int argc, char** argv) {
  const bool update = argc == 3 && std::string_view(argv[2]) == "--update";
  if (argc != 2 && !update) {
    fmt::print("format_keys PAGE [--update]\n");
    return 2;
  }
  try {
    const bool hold = ballbar::defaults_hold();
    return ballbar::held(argv[1], update) == 0 && hold ? 0 : 1;
  } catch (const std::exception& error) {
    fmt::print("{}\n", error.what());
    return 1;
  }
}
