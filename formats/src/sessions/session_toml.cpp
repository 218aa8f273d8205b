#include "ballbar/formats/sessions/session_toml.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "ballbar/error.hpp"
#include "text/head.hpp"
#include "text/located_text.hpp"
#include "text/path_inside.hpp"
#include "text/readers.hpp"
#include "text/toml_source.hpp"

namespace ballbar {
namespace {

constexpr std::string_view kSessionFormat = "ballbar-session 1";

constexpr Key kSessionKeys[] = {
    {"format", "text", "\"ballbar-session 1\"; needed"},
    {"method", "text", "\"circles\", \"two_arcs\" or \"spindle_rotation\"; needed"},
    {"title", "text", "stands above the results"},
    {"spindle_above", "true or false",
     "`spindle_rotation`: growth of the spindle shortens the axial bar; false: the ball is on the far side; default "
     "true"},
    {"bar", "table", "the bar; needed"},
    {"test", "tables", "a test each, in the order of time; at least one"},
    {"signals", "table", "other logged signals"},
    {"five_probe", "table", "readings of five probes in the same session"},
};
constexpr Key kBarKeys[] = {
    {"nominal_length_mm", "mm", "nominal length, above 0; needed"},
    {"expansion_ppm_per_K", "ppm/K",
     "thermal expansion; where the logs state the bar's temperature, `compare` counts it as uncertainty"},
};
constexpr Key kTestKeys[] = {
    {"elapsed_s", "s", "when the test began, from the session's own zero; rises from test to test; needed"},
};
constexpr Key kCirclesKeys[] = {
    {"circle", "path", "recording of the circle; needed"},
};
constexpr Key kTwoArcsKeys[] = {
    {"c_arc", "path", "recording of the arc about the rotary axis C; needed"},
    {"a_arc", "path", "recording of the arc about the rotary axis A; needed"},
};
constexpr Key kRotationKeys[] = {
    {"rotation", "path", "recording while the spindle turns; needed"},
    {"axial", "path", "axial recording; this or the next"},
    {"axial_length_mm", "mm", "one length of the axial bar, above 0"},
};
constexpr Key kSignalsKeys[] = {
    {"files", "paths", "series of temperatures, speed and the like; needed"},
};
constexpr Key kFiveProbeKeys[] = {
    {"file", "path", "the series of the probes; needed"},
    {"ball_from_plane_1_mm", "mm", "distance of the ball from plane 1, towards plane 2"},
    {"ball_sigma_mm", "mm", "its uncertainty, one sigma"},
};

// Lexically; open_session looks at links too.
void expect_inside(const TomlTable& table, std::string_view key, const std::string& path,
                   std::optional<std::size_t> element = std::nullopt) {
  if (stays_inside(path)) return;
  const std::string sentence =
      fmt::format("expected a path to a file inside the session's folder for {}, found {}.", key, in_quotes(path));
  element ? fail_at_element(table, key, *element, sentence) : fail_at_key(table, key, sentence);
}

std::string path_at(const TomlTable& table, std::string_view key) {
  const std::optional<std::string> path = string(table, key);
  if (path) expect_inside(table, key, *path);
  return path.value_or("");
}

// The keys of a test that belong to each method.
std::vector<std::string_view> keys_of(Method method) {
  if (method == Method::two_arcs) return names_of(kTwoArcsKeys);
  return names_of(method == Method::spindle_rotation ? std::span<const Key>(kRotationKeys) : kCirclesKeys);
}

SessionPlan::Test test_of(const TomlTable& table, Method method) {
  for (const Method other : {Method::two_arcs, Method::spindle_rotation, Method::circles}) {
    if (other == method) continue;
    for (const std::string_view key : keys_of(other)) {
      if (!has(table, key)) continue;
      fail_at_key(table, key,
                  fmt::format("expected a key of the method {} ({}), found {}, a key of {}.", name_of(method),
                              fmt::join(keys_of(method), ", "), key, name_of(other)));
    }
  }
  std::vector<std::string_view> known = keys_of(method);
  for (const Key& key : kTestKeys) known.push_back(key.name);
  expect_keys(table, known);
  SessionPlan::Test test;
  test.elapsed_s = required(number, table, "elapsed_s");
  for (const auto& [key, member] : SessionPlan::kFiles) test.*member = path_at(table, key);
  test.axial_length_mm = positive(table, "axial_length_mm");
  for (const std::string_view key : keys_of(method)) {
    if (!key.starts_with("axial") && !has(table, key)) fail_missing(table, key);
  }
  if (method == Method::spindle_rotation && has(table, "axial") == has(table, "axial_length_mm")) {
    const std::string_view amount = has(table, "axial") ? "both" : "none";
    fail_at_key(table, "axial_length_mm",
                fmt::format("expected either axial or axial_length_mm in {}, found {}.", table.label, amount));
  }
  return test;
}

}  // namespace

std::vector<KeyTable> session_keys() {
  return {{"", kSessionKeys},
          {"`[bar]`", kBarKeys},
          {"`[[test]]`", kTestKeys},
          {"`[[test]]` of `circles`", kCirclesKeys},
          {"`[[test]]` of `two_arcs`", kTwoArcsKeys},
          {"`[[test]]` of `spindle_rotation`", kRotationKeys},
          {"`[signals]`", kSignalsKeys},
          {"`[five_probe]`", kFiveProbeKeys}};
}

constinit const Reader readers::kSession = {
    .found = "a session",
    .is_yours = [](std::string_view head) { return format_name(head) == "ballbar-session"; },
    .read = read_session_plan,
};

SessionPlan read_session_plan(std::string_view bytes, std::string_view name) {
  const SourceText text = source_text(bytes, name);
  const TomlSource source = parse_toml(text.bytes, name);
  const TomlTable root = root_of(source);
  expect_format(root, kSessionFormat);
  expect_keys(root, kSessionKeys);

  SessionPlan plan;
  plan.method = required_choice(root, "method", {Method::two_arcs, Method::spindle_rotation, Method::circles});
  plan.title = string(root, "title").value_or("");
  plan.spindle_above = boolean(root, "spindle_above").value_or(true);
  const TomlTable bar = required(subtable, root, "bar");
  expect_keys(bar, kBarKeys);
  plan.bar_expansion_ppm_per_K = number(bar, "expansion_ppm_per_K");
  plan.nominal_length_mm = required(positive, bar, "nominal_length_mm");
  for (const TomlTable& table : subtables(root, "test")) {
    const SessionPlan::Test test = test_of(table, plan.method);
    if (!plan.tests.empty() && !(test.elapsed_s > plan.tests.back().elapsed_s)) {
      fail_at_key(table, "elapsed_s",
                  fmt::format("expected elapsed_s above {} of the test before, found {}.", plan.tests.back().elapsed_s,
                              test.elapsed_s));
    }
    plan.tests.push_back(test);
  }
  if (plan.tests.empty()) fail_at_key(root, "test", "expected at least one [[test]], found none.");
  if (const auto signals = subtable(root, "signals")) {
    expect_keys(*signals, kSignalsKeys);
    plan.signal_files = required(strings, *signals, "files");
    for (std::size_t i = 0; i < plan.signal_files.size(); ++i)
      expect_inside(*signals, "files", plan.signal_files[i], i);
  }
  if (const auto five_probe = subtable(root, "five_probe")) {
    expect_keys(*five_probe, kFiveProbeKeys);
    if (!has(*five_probe, "file")) fail_missing(*five_probe, "file");
    plan.five_probe_file = path_at(*five_probe, "file");
    plan.ball = {number(*five_probe, "ball_from_plane_1_mm"), positive(*five_probe, "ball_sigma_mm")};
  }
  return plan;
}

std::string write_session_plan(const SessionPlan& plan) {
  std::string out = fmt::format("format = \"{}\"\nmethod = \"{}\"\n", kSessionFormat, name_of(plan.method));
  if (!plan.title.empty()) out += fmt::format("title = {}\n", toml_quoted(plan.title));
  if (!plan.spindle_above) out += "spindle_above = false\n";
  out += fmt::format("\n[bar]\nnominal_length_mm = {}\n", toml_number(plan.nominal_length_mm));
  if (plan.bar_expansion_ppm_per_K) {
    out += fmt::format("expansion_ppm_per_K = {}\n", toml_number(*plan.bar_expansion_ppm_per_K));
  }
  for (const SessionPlan::Test& test : plan.tests) {
    out += fmt::format("\n[[test]]\nelapsed_s = {}\n", toml_number(test.elapsed_s));
    for (const auto& [key, member] : SessionPlan::kFiles) {
      if (!(test.*member).empty()) out += fmt::format("{} = {}\n", key, toml_quoted(test.*member));
    }
    if (test.axial_length_mm) out += fmt::format("axial_length_mm = {}\n", toml_number(*test.axial_length_mm));
  }
  if (!plan.signal_files.empty()) {
    std::vector<std::string> files;
    for (const std::string& file : plan.signal_files) files.push_back(toml_quoted(file));
    out += fmt::format("\n[signals]\nfiles = [{}]\n", fmt::join(files, ", "));
  }
  if (!plan.five_probe_file.empty()) {
    out += fmt::format("\n[five_probe]\nfile = {}\n", toml_quoted(plan.five_probe_file));
    if (plan.ball.from_plane_1_mm) {
      out += fmt::format("ball_from_plane_1_mm = {}\n", toml_number(*plan.ball.from_plane_1_mm));
    }
    if (plan.ball.sigma_mm) out += fmt::format("ball_sigma_mm = {}\n", toml_number(*plan.ball.sigma_mm));
  }
  return out;
}

}  // namespace ballbar
