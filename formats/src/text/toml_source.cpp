#define TOML_IMPLEMENTATION
#include "text/toml_source.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cmath>
#include <ctime>

#include "ballbar/error.hpp"
#include "text/located_text.hpp"

namespace ballbar {
namespace {

[[noreturn]] void fail(std::string_view name, const toml::source_position& place, std::string_view sentence) {
  // A table that only its subtables imply has no place of its own.
  throw Error(fmt::format("{}:{}:{}: {}", name, place.line == 0 ? 1 : place.line, place.column == 0 ? 1 : place.column,
                          sentence));
}

std::string found(const toml::node& node) {
  if (const auto* value = node.as_string()) return "the text " + in_quotes(value->get());
  if (const auto* value = node.as_integer()) return fmt::format("the integer {}", value->get());
  if (const auto* value = node.as_floating_point()) return fmt::format("the number {}", value->get());
  if (const auto* value = node.as_boolean()) return value->get() ? "true" : "false";
  if (node.is_array()) return "an array";
  if (node.is_table()) return "a table";
  return node.is_date_time() ? "a date with a time" : node.is_date() ? "a date" : "a time";
}

[[noreturn]] void fail_kind(const TomlTable& table, std::string_view key, std::string_view expected,
                            const toml::node& node) {
  fail(table.name, node.source().begin, fmt::format("expected {} for {}, found {}.", expected, key, found(node)));
}

template <class Value>
std::optional<Value> value_of(const TomlTable& table, std::string_view key, std::string_view expected) {
  const toml::node* const node = table.table->get(key);
  if (!node) return std::nullopt;
  const auto* const value = node->as<Value>();
  if (!value) fail_kind(table, key, expected, *node);
  return value->get();
}

std::optional<double> finite(const toml::node& node) {
  if (const auto* value = node.as_integer()) return static_cast<double>(value->get());
  if (const auto* value = node.as_floating_point(); value && std::isfinite(value->get())) return value->get();
  return std::nullopt;
}

const toml::array* array(const TomlTable& table, std::string_view key, std::string_view expected) {
  const toml::node* node = table.table->get(key);
  if (node && !node->is_array()) fail_kind(table, key, expected, *node);
  return node ? node->as_array() : nullptr;
}

// Dotted keys nest tables, and a table frees its tables recursively: depth costs stack. No sane key has
// this many parts; brackets are bounded by the parser itself.
void expect_shallow(const SourceText& text) {
  constexpr int kMostDots = 100;
  int dots = 0;
  for (std::size_t i = 0; i < text.bytes.size(); ++i) {
    const char c = text.bytes[i];
    if (c == '.') ++dots;
    if (c == '\n' || c == ',' || c == '=') dots = 0;
    if (dots > kMostDots) {
      fail_at(text, i, fmt::format("expected a key or text with at most {} dots, found more.", kMostDots));
    }
  }
}

struct ParserFault {};

bool is_fault(std::string_view text) {
  try {
    static_cast<void>(toml::parse(text));
  } catch (const ParserFault&) {
    return true;
  } catch (const toml::parse_error&) {
  }
  return false;
}

// Length of the shortest beginning of `text` that the parser cannot take, which it reads from front to back.
std::size_t fault_length(std::string_view text) {
  std::size_t good = 0;
  std::size_t bad = text.size();
  while (bad - good > 1) {
    const std::size_t middle = good + (bad - good) / 2;
    (is_fault(text.substr(0, middle)) ? bad : good) = middle;
  }
  return bad;
}

}  // namespace

void toml_parser_fault() { throw ParserFault{}; }

TomlSource parse_toml(std::string_view text, std::string_view name) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  expect_shallow({text, name});
  try {
    return {toml::parse(text), std::string(name)};
  } catch (const ParserFault&) {
    const std::size_t length = fault_length(text);
    fail_at({text, name}, length - 1, fmt::format("expected TOML, found {}.", in_quotes(text.substr(length - 1, 1))));
  } catch (const toml::parse_error& error) {
    const bool comma = error.description().ends_with("saw ','");
    fail(name, error.source().begin,
         fmt::format("expected TOML, found text that its parser refuses: {}{}.", error.description(),
                     comma ? "; decimals need a point" : ""));
  }
}

std::vector<std::string_view> names_of(std::span<const Key> keys) {
  std::vector<std::string_view> names;
  for (const Key& key : keys) names.push_back(key.name);
  return names;
}

TomlTable root_of(const TomlSource& source) { return {&source.root, source.name, ""}; }

void expect_keys(const TomlTable& table, std::span<const std::string_view> known,
                 std::span<const std::string_view> ignored) {
  // In the order of the file: a toml::table is sorted by name.
  const toml::key* first = nullptr;
  for (const auto& [key, value] : *table.table) {
    const auto is_in = [name = key.str()](std::span<const std::string_view> names) {
      return std::find(names.begin(), names.end(), name) != names.end();
    };
    if (is_in(known) || is_in(ignored)) continue;
    const auto place = key.source().begin;
    if (!first || place.line < first->source().begin.line ||
        (place.line == first->source().begin.line && place.column < first->source().begin.column)) {
      first = &key;
    }
  }
  if (!first) return;
  const std::string place = table.label.empty() ? "" : " in " + table.label;
  if (known.size() == 1) {
    fail(table.name, first->source().begin,
         fmt::format("expected no key but {}{}, found {}.", known[0], place, in_quotes(first->str())));
  }
  constexpr std::size_t kMostListed = 30;
  const std::string names = known.size() > kMostListed ? fmt::format("{} known keys", known.size())
                                                       : fmt::format("keys {}", fmt::join(known, ", "));
  fail(table.name, first->source().begin,
       fmt::format("expected one of the {}{}, found {}; the nearest is {}.", names, place, in_quotes(first->str()),
                   nearest_name(first->str(), known)));
}

void expect_keys(const TomlTable& table, std::span<const Key> known, std::span<const std::string_view> ignored) {
  expect_keys(table, names_of(known), ignored);
}

bool has(const TomlTable& table, std::string_view key) { return table.table->contains(key); }

std::optional<std::string> string(const TomlTable& table, std::string_view key) {
  return value_of<std::string>(table, key, "a text in quotes");
}

std::optional<double> number(const TomlTable& table, std::string_view key) {
  const toml::node* node = table.table->get(key);
  if (!node) return std::nullopt;
  const std::optional<double> value = finite(*node);
  if (!value) fail_kind(table, key, "a finite number", *node);
  return value;
}

std::optional<double> positive(const TomlTable& table, std::string_view key) {
  const std::optional<double> value = number(table, key);
  if (value && !(*value > 0.0)) fail_kind(table, key, "a number above 0", *table.table->get(key));
  return value;
}

std::optional<std::int64_t> integer(const TomlTable& table, std::string_view key) {
  return value_of<std::int64_t>(table, key, "an integer");
}

std::optional<bool> boolean(const TomlTable& table, std::string_view key) {
  return value_of<bool>(table, key, "true or false");
}

std::optional<std::int64_t> local_time_s(const TomlTable& table, std::string_view key) {
  const toml::node* node = table.table->get(key);
  if (!node) return std::nullopt;
  const auto* value = node->as_date_time();
  if (!value) fail_kind(table, key, "a date and time such as 2015-03-02T09:00:00, without quotes,", *node);
  if (value->get().offset) {
    fail(table.name, node->source().begin, fmt::format("expected a local time for {}, found one with a zone.", key));
  }
  const auto& [date, time, offset] = value->get();
  const std::chrono::sys_days day = std::chrono::year(date.year) / date.month / date.day;
  return std::chrono::seconds(day.time_since_epoch()).count() + time.hour * 3600 + time.minute * 60 + time.second;
}

std::optional<std::vector<double>> numbers(const TomlTable& table, std::string_view key) {
  const toml::array* values = array(table, key, "an array of numbers");
  if (!values) return std::nullopt;
  std::vector<double> result;
  for (const toml::node& node : *values) {
    const std::optional<double> value = finite(node);
    if (!value) fail_kind(table, key, "an array of finite numbers", node);
    result.push_back(*value);
  }
  return result;
}

std::optional<std::vector<std::string>> strings(const TomlTable& table, std::string_view key) {
  const toml::array* values = array(table, key, "an array of texts");
  if (!values) return std::nullopt;
  std::vector<std::string> result;
  for (const toml::node& node : *values) {
    if (!node.is_string()) fail_kind(table, key, "an array of texts", node);
    result.push_back(node.as_string()->get());
  }
  return result;
}

std::optional<TomlTable> subtable(const TomlTable& table, std::string_view key) {
  const toml::node* node = table.table->get(key);
  if (!node) return std::nullopt;
  if (!node->is_table()) fail_kind(table, key, fmt::format("a table [{}]", key), *node);
  return TomlTable{node->as_table(), table.name, fmt::format("[{}]", key)};
}

std::vector<TomlTable> subtables(const TomlTable& table, std::string_view key) {
  const std::string expected = fmt::format("tables [[{}]]", key);
  std::vector<TomlTable> result;
  const toml::array* values = array(table, key, expected);
  if (!values) return result;
  for (const toml::node& node : *values) {
    if (!node.is_table()) fail_kind(table, key, expected, node);
    result.push_back({node.as_table(), table.name, fmt::format("[[{}]] {}", key, result.size() + 1)});
  }
  return result;
}

std::optional<std::size_t> choice_index(const TomlTable& table, std::string_view key,
                                        std::span<const std::string_view> names) {
  const toml::node* node = table.table->get(key);
  if (!node) return std::nullopt;
  if (const auto* value = node->as_string()) {
    const auto name = std::find(names.begin(), names.end(), value->get());
    if (name != names.end()) return static_cast<std::size_t>(name - names.begin());
  }
  fail_kind(table, key, fmt::format("{}\"{}\"", names.size() > 1 ? "one of " : "", fmt::join(names, "\", \"")), *node);
}

void expect_format(const TomlTable& root, std::string_view format) {
  if (!choice_index(root, "format", {&format, 1})) fail_missing(root, "format");
}

std::optional<Role> role_choice(const TomlTable& table, std::string_view key) {
  std::vector<std::string_view> names;
  for (int role = 0; role <= static_cast<int>(Role::measured); ++role) {
    names.push_back(name_of(static_cast<Role>(role)));
  }
  const std::optional<std::size_t> index = choice_index(table, key, names);
  return index ? std::optional(static_cast<Role>(*index)) : std::nullopt;
}

void fail_missing(const TomlTable& table, std::string_view key) {
  fail_at_table(
      table, fmt::format("expected the key {}{}, found none.", key, table.label.empty() ? "" : " in " + table.label));
}

void fail_at_key(const TomlTable& table, std::string_view key, std::string_view sentence) {
  const toml::node* node = table.table->get(key);
  fail(table.name, (node ? node->source() : table.table->source()).begin, sentence);
}

void fail_at_table(const TomlTable& table, std::string_view sentence) {
  fail(table.name, table.table->source().begin, sentence);
}

void fail_kind(const TomlTable& table, std::string_view key, std::string_view expected) {
  fail_kind(table, key, expected, *table.table->get(key));
}

void fail_at_element(const TomlTable& table, std::string_view key, std::size_t index, std::string_view sentence) {
  fail(table.name, table.table->get(key)->as_array()->get(index)->source().begin, sentence);
}

std::string toml_key(const std::string& name) {
  const bool bare = !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_' || c == '-';
  });
  return bare ? name : toml_quoted(name);
}

std::string toml_quoted(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      result += '\\';
      result += c;
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      result += fmt::format("\\u{:04X}", static_cast<unsigned>(c));
    } else {
      result += c;
    }
  }
  return result + '"';
}

// A TOML float has a point or an exponent; an integer of more than 64 bits is none.
std::string toml_number(double number) {
  std::string result = fmt::format("{}", number);
  if (result.find_first_of(".en") == std::string::npos) result += ".0";
  return result;
}

std::string toml_local_time(std::int64_t local_time_s) {
  return fmt::format("{:%Y-%m-%dT%H:%M:%S}", fmt::gmtime(static_cast<std::time_t>(local_time_s)));
}

}  // namespace ballbar
