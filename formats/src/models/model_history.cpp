#include "ballbar/formats/models/model_history.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "ballbar/error.hpp"
#include "ballbar/formats/models/model_toml.hpp"
#include "text/located_text.hpp"
#include "text/table_place.hpp"
#include "text/toml_source.hpp"

namespace ballbar {
namespace {

constexpr Key kKeys[] = {
    {"revision", "number", "0 for the initial model; increases by one"},
    {"change", "text", "\"start\", \"+ effect\", \"- effect\" or \"= parameter\""},
    {"target", "text", "column of the figures"},
    {"data", "texts", "files, as named on the command line"},
    {"parameters", "number", "how many parameters are free"},
    {"rmse_um", "um", "root mean square of the residual"},
    {"times_floor", "1", "that relative to the noise; absent if the noise is not known"},
    {"held_out_um", "um", "the same for cycles, or recordings, that are left out and predicted from the others"},
    {"likelihood_ratio", "1", "2 ln B of the change; chi^2 for axis errors"},
    {"threshold", "1", "its threshold"},
    {"forecast_um", "um", "root mean square error of rows forecast from earlier ones alone"},
    {"discrepancy_um", "um", "standard deviation of the slow curve in the residual"},
    {"verdict", "text",
     "\"start\", \"named\", \"supported\", \"time only\", \"not supported\", \"driver known\", \"empirical\" or \"by "
     "hand\""},
    {"still_needed", "texts", "earlier effects that are still needed"},
    {"no_longer_needed", "texts", "earlier effects that are no longer needed"},
    {"effects_before", "text", "the effects before, unchanged; `undo` restores them"},
};

// Keys that ballbar 0.2.0 wrote and nothing reads.
constexpr std::string_view kIgnored[] = {"best_surrogate_fall", "surrogate_forecast_um"};

// A number of a row, which may be missing.
struct Figure {
  std::string_view key;
  double LedgerRow::*member;
  bool at_least_0 = true;
};
constexpr Figure kFigures[] = {{"rmse_um", &LedgerRow::rmse_um},
                               {"times_floor", &LedgerRow::times_floor},
                               {"held_out_um", &LedgerRow::held_out_um},
                               {"likelihood_ratio", &LedgerRow::likelihood_ratio, false},
                               {"threshold", &LedgerRow::threshold, false},
                               {"forecast_um", &LedgerRow::forecast_um},
                               {"discrepancy_um", &LedgerRow::discrepancy_um}};

// Of the text without its byte order mark.
struct Places {
  std::size_t effects = 0;         // the end of what stands before the first effect, its comments and blank lines
  std::size_t history = 0;         // the first row with the comments directly above it; the end of the text
  std::vector<std::size_t> begin;  // of every effect, with the comments directly above it
  std::vector<std::size_t> rows;   // of the history, without them
};

std::size_t without_blanks(std::string_view text, std::size_t end) {
  return text.substr(0, end).find_last_not_of(" \t\r\n") + 1;
}

Places places_of(std::string_view text, const TomlTable& root) {
  const std::vector<TomlTable> effects = subtables(root, "effect"), history = subtables(root, "history");
  if (has(root, "effect") && (effects.empty() || !has_header(text, effects[0]))) {
    if (effects.empty()) fail_at_key(root, "effect", "expected effects as tables [[effect]], found an empty array.");
    fail_at_table(effects[0], "expected effects as tables [[effect]], found an array.");
  }
  if (has(root, "history") && (history.empty() || !has_header(text, history[0]))) {
    if (history.empty())
      fail_at_key(root, "history", "expected the history as tables [[history]], found an empty array.");
    fail_at_table(history[0], "expected the history as tables [[history]], found an array.");
  }
  if (!effects.empty() && !history.empty() && is_before(history[0], effects.back())) {
    fail_at_table(effects.back(), "expected the effects above the history, found one below it.");
  }
  Places places;
  places.history = history.empty() ? text.size() : start_with_comments(text, history[0]);
  places.effects = without_blanks(text, effects.empty() ? places.history : start_with_comments(text, effects[0]));
  for (const TomlTable& effect : effects) places.begin.push_back(start_with_comments(text, effect));
  for (const TomlTable& row : history) places.rows.push_back(line_start(text, row));
  return places;
}

LedgerRow row_at(const TomlTable& table, std::size_t place) {
  expect_keys(table, kKeys, kIgnored);
  LedgerRow row;
  const std::int64_t revision = required(integer, table, "revision");
  if (revision != static_cast<std::int64_t>(place)) {
    fail_at_key(table, "revision", fmt::format("expected revision {}, found {}.", place, revision));
  }
  row.revision = place;
  row.change = required(string, table, "change");
  const bool is_change = row.change.starts_with("+ ") || row.change.starts_with("- ") || row.change.starts_with("= ");
  if (place == 0 ? row.change != "start" : !is_change) {
    fail_at_key(
        table, "change",
        fmt::format("expected {}, found {}.",
                    place == 0 ? "\"start\"" : "\"+ effect\", \"- effect\" or \"= parameter\"", in_quotes(row.change)));
  }
  row.target = required(string, table, "target");
  row.data = required(strings, table, "data");
  const std::int64_t parameters = required(integer, table, "parameters");
  if (parameters < 0) {
    fail_at_key(table, "parameters", fmt::format("expected parameters of at least 0, found {}.", parameters));
  }
  row.parameters = static_cast<std::size_t>(parameters);
  if (!has(table, "rmse_um")) fail_missing(table, "rmse_um");
  for (const auto& [key, member, at_least_0] : kFigures) {
    row.*member = number(table, key).value_or(LedgerRow::kUnknown);
    if (!at_least_0 || !(row.*member < 0.0)) continue;
    fail_at_key(table, key, fmt::format("expected {} of at least 0, found {}.", key, row.*member));
  }
  row.verdict = required(string, table, "verdict");
  row.still_needed = strings(table, "still_needed").value_or(std::vector<std::string>{});
  row.no_longer_needed = strings(table, "no_longer_needed").value_or(std::vector<std::string>{});
  if (place > 0) static_cast<void>(required(string, table, "effects_before"));
  if (place == 0 && has(table, "effects_before")) {
    fail_at_key(table, "effects_before", "expected no effects_before in revision 0, which nothing is before.");
  }
  return row;
}

std::vector<LedgerRow> ledger_of(const TomlTable& root) {
  std::vector<LedgerRow> rows;
  const bool of_recordings = string(root, "level").value_or("series") == "recording";
  for (const TomlTable& table : subtables(root, "history")) {
    rows.push_back(row_at(table, rows.size()));
    if (of_recordings) rows.back().level = Level::recording;
  }
  return rows;
}

std::string list_text(const std::vector<std::string>& texts) {
  std::vector<std::string> quoted;
  quoted.reserve(texts.size());
  for (const std::string& text : texts) quoted.push_back(toml_quoted(text));
  return fmt::format("[{}]", fmt::join(quoted, ", "));
}

// As it stands where TOML lets it.
std::string block_text(const std::string& text) {
  const bool plain = text.find("'''") == std::string::npos && !text.ends_with('\'') &&
                     std::all_of(text.begin(), text.end(), [](char c) {
                       return c == '\n' || c == '\t' || (static_cast<unsigned char>(c) >= 0x20 && c != 0x7f);
                     });
  return plain ? fmt::format("'''\n{}'''", text) : toml_quoted(text);
}

std::string row_text(const LedgerRow& row, const std::string* effects_before) {
  std::string out =
      fmt::format("[[history]]\nrevision = {}\nchange = {}\ntarget = {}\ndata = {}\nparameters = {}\n", row.revision,
                  toml_quoted(row.change), toml_quoted(row.target), list_text(row.data), row.parameters);
  for (const Figure& figure : kFigures) {
    const double value = row.*figure.member;
    if (std::isfinite(value)) out += fmt::format("{} = {}\n", figure.key, toml_number(value));
  }
  out += fmt::format("verdict = {}\n", toml_quoted(row.verdict));
  if (effects_before == nullptr) return out;
  out += fmt::format("still_needed = {}\nno_longer_needed = {}\neffects_before = {}\n", list_text(row.still_needed),
                     list_text(row.no_longer_needed), block_text(*effects_before));
  return out;
}

// The text without some of its effects.
std::string cut(std::string_view text, const Places& places, std::span<const std::size_t> removed) {
  std::string result(text);
  for (auto effect = removed.rbegin(); effect != removed.rend(); ++effect) {
    const std::size_t begin = places.begin.at(*effect);
    const std::size_t end = *effect + 1 < places.begin.size() ? places.begin[*effect + 1] : places.history;
    result.erase(begin, end - begin);
  }
  return result;
}

}  // namespace

std::vector<KeyTable> history_keys() { return {{"`[[history]]`", kKeys}}; }

std::vector<LedgerRow> read_ledger(std::string_view bytes, std::string_view name, const Catalogue& catalogue) {
  const SourceText text = source_text(bytes, name);
  static_cast<void>(read_model(bytes, name, catalogue));
  const TomlSource source = parse_toml(text.bytes, name);
  return ledger_of(root_of(source));
}

std::string with_revision(std::string_view bytes, std::string_view name, std::span<const Term> added,
                          std::span<const std::size_t> removed, const LedgerRow& start, LedgerRow row,
                          const Catalogue& catalogue) {
  const SourceText text = source_text(bytes, name);
  static_cast<void>(read_model(bytes, name, catalogue));
  const TomlSource source = parse_toml(text.bytes, name);
  const Places places = places_of(text.bytes, root_of(source));
  const std::size_t rows = ledger_of(root_of(source)).size();
  const std::string before(text.bytes.substr(places.effects, places.history - places.effects));
  std::string result =
      std::string(bytes.substr(0, bytes.size() - text.bytes.size())) + cut(text.bytes, places, removed);
  for (const Term& term : added) result = with_effect(result, name, term, catalogue);
  const auto append = [&](const LedgerRow& more, const std::string* effects_before) {
    if (!result.ends_with('\n')) result += '\n';
    result += '\n' + row_text(more, effects_before);
  };
  if (rows == 0) {
    LedgerRow first = start;
    first.revision = 0;
    append(first, nullptr);
  }
  row.revision = std::max<std::size_t>(1, rows);
  append(row, &before);
  static_cast<void>(read_ledger(result, name, catalogue));
  return result;
}

std::string without_last_revision(std::string_view bytes, std::string_view name, const Catalogue& catalogue) {
  const SourceText text = source_text(bytes, name);
  static_cast<void>(read_model(bytes, name, catalogue));
  const TomlSource source = parse_toml(text.bytes, name);
  const TomlTable root = root_of(source);
  const Places places = places_of(text.bytes, root);
  const std::vector<LedgerRow> rows = ledger_of(root);
  if (rows.size() < 2) {
    throw Error(fmt::format("{}: expected a revision to take back, found none: the model is as it started.", name));
  }
  const TomlTable last = subtables(root, "history").back();
  std::string result(bytes.substr(0, bytes.size() - text.bytes.size() + places.effects));
  result += required(string, last, "effects_before");
  if (rows.size() == 2) {
    result += text.bytes.substr(places.history, places.rows[0] - places.history);  // comments of the user's
  } else {
    std::string_view kept = text.bytes.substr(places.history, places.rows.back() - places.history);
    kept = kept.substr(0, without_blanks(kept, kept.size()));
    result += kept;
    result += '\n';
  }
  try {
    static_cast<void>(read_model(result, "the text", catalogue));
    static_cast<void>(read_ledger(result, "the text", catalogue));
  } catch (const Error& error) {
    fail_at_key(last, "effects_before",
                fmt::format("expected the effects as they were, found a fault: {}", error.what()));
  }
  return result;
}

}  // namespace ballbar
