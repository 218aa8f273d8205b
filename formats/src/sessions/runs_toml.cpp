#include "ballbar/formats/sessions/runs_toml.hpp"

#include <fmt/format.h>

#include "ballbar/error.hpp"
#include "ballbar/formats/text/keys.hpp"
#include "ballbar/formats/text/source.hpp"
#include "text/head.hpp"
#include "text/located_text.hpp"
#include "text/path_inside.hpp"
#include "text/readers.hpp"
#include "text/toml_source.hpp"

namespace ballbar {
namespace {

constexpr std::string_view kRunsFormat = "ballbar-runs 1";
constexpr std::size_t kMostRuns = 1000;

constexpr Key kRunsKeys[] = {
    {"format", "text", "\"ballbar-runs 1\"; needed"},
    {"title", "text", "stands above the results"},
    {"run", "tables", "a run each, in the order of time; at least one"},
};
constexpr Key kRunKeys[] = {
    {"file", "path", "a series or a session; needed"},
    {"starts", "text",
     "\"rest\" or \"warm\"; without it: warm where it began less than 8 h after another, or turns in its first row"},
};

}  // namespace

std::vector<KeyTable> runs_keys() { return {{"", kRunsKeys}, {"`[[run]]`", kRunKeys}}; }

constinit const Reader readers::kRuns = {
    .found = "a list of runs",
    .is_yours = [](std::string_view head) { return format_name(head) == "ballbar-runs"; },
};

RunsOfMachine read_run_list(std::string_view bytes, std::string_view name) {
  const SourceText text = source_text(bytes, name);
  const TomlSource source = parse_toml(text.bytes, name);
  const TomlTable root = root_of(source);
  expect_format(root, kRunsFormat);
  expect_keys(root, kRunsKeys);
  RunsOfMachine result;
  result.title = string(root, "title").value_or("");
  const std::string_view starts[] = {"rest", "warm"};
  for (const TomlTable& table : subtables(root, "run")) {
    expect_keys(table, kRunKeys);
    RunOfMachine run;
    run.file = required(string, table, "file");
    if (!stays_inside(run.file)) {
      fail_at_key(
          table, "file",
          fmt::format("expected a path to a file inside the list's folder for file, found {}.", in_quotes(run.file)));
    }
    if (const auto start = choice_index(table, "starts", starts)) {
      run.start = *start == 0 ? RunStart::rest : RunStart::warm;
    }
    result.runs.push_back(std::move(run));
    if (result.runs.size() > kMostRuns) {
      fail_at_key(table, "file", fmt::format("expected at most {} runs, found more.", kMostRuns));
    }
  }
  if (result.runs.empty()) fail_at_key(root, "run", "expected at least one [[run]], found none.");
  return result;
}

bool lists_runs(const Source& source, std::span<const Reader> readers) {
  const Reader* const reader = source.reader(readers);
  return reader != nullptr && reader->found == readers::kRuns.found;
}

}  // namespace ballbar
