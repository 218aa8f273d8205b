// TOML text as checked values. Every error is one sentence: name:line:column, what was expected, what was
// found, and the choices where there are any. Used by the session, log, series and machine readers.
//
//   const TomlSource source = parse_toml(bytes, name);
//   const TomlTable root = root_of(source);
//   expect_keys(root, {"plane", "title"});
//   const Plane plane = choice(root, "plane", {Plane::XY, Plane::YZ, Plane::ZX}).value_or(Plane::XY);
//   const double feed_mm_per_min = required(positive, root, "feed_mm_per_min");
//
// A getter gives nothing where the key is absent and throws Error where its value is of another kind.
#pragma once

#define TOML_HEADER_ONLY 0  // the parser is compiled once, in toml_source.cpp
#include <toml++/toml.h>

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace ballbar {

struct TomlSource {
  toml::table root;
  std::string name;  // stands in messages
};

// One table of a source, which must outlive it.
struct TomlTable {
  const toml::table* table = nullptr;
  std::string name;   // of the source
  std::string label;  // "[bar]", "[[test]] 3"; empty for the root
};

// Throws Error with the place of a syntax error. A byte order mark is skipped.
TomlSource parse_toml(std::string_view text, std::string_view name);

TomlTable root_of(const TomlSource& source);
TomlTable root_of(TomlSource&&) = delete;

// Throws Error at the first key that is not in `known`, with the nearest known name.
void expect_keys(const TomlTable& table, std::span<const std::string_view> known);
void expect_keys(const TomlTable& table, std::initializer_list<std::string_view> known);

bool has(const TomlTable& table, std::string_view key);
std::optional<std::string> string(const TomlTable& table, std::string_view key);
std::optional<double> number(const TomlTable& table, std::string_view key);    // integers too; finite
std::optional<double> positive(const TomlTable& table, std::string_view key);  // a number > 0
std::optional<std::int64_t> integer(const TomlTable& table, std::string_view key);
std::optional<bool> boolean(const TomlTable& table, std::string_view key);
// A local date-time, 2015-03-02T09:00:00, as s since 1970-01-01T00:00:00 on the same clock.
std::optional<std::int64_t> local_time_s(const TomlTable& table, std::string_view key);
std::optional<std::vector<double>> numbers(const TomlTable& table, std::string_view key);
std::optional<std::vector<std::string>> strings(const TomlTable& table, std::string_view key);
std::optional<TomlTable> subtable(const TomlTable& table, std::string_view key);  // [key]
std::vector<TomlTable> subtables(const TomlTable& table, std::string_view key);   // [[key]], none: empty

// Position of the key's text in `names`, which are the only ones accepted.
std::optional<std::size_t> choice_index(const TomlTable& table, std::string_view key,
                                        std::span<const std::string_view> names);

// One of the values that name_of() names.
template <class Value>
std::optional<Value> choice(const TomlTable& table, std::string_view key, std::initializer_list<Value> values) {
  std::vector<std::string_view> names;
  for (const Value value : values) names.push_back(name_of(value));
  const std::optional<std::size_t> index = choice_index(table, key, names);
  if (!index) return std::nullopt;
  return values.begin()[*index];
}

// Throws Error: the table lacks the key.
[[noreturn]] void fail_missing(const TomlTable& table, std::string_view key);

template <class Value>
Value required_choice(const TomlTable& table, std::string_view key, std::initializer_list<Value> values) {
  const std::optional<Value> value = choice(table, key, values);
  if (!value) fail_missing(table, key);
  return *value;
}

// required(number, table, "elapsed_s"): the getter's value; throws Error where the key is absent.
template <class Value>
Value required(std::optional<Value> (*getter)(const TomlTable&, std::string_view), const TomlTable& table,
               std::string_view key) {
  std::optional<Value> value = getter(table, key);
  if (!value) fail_missing(table, key);
  return *std::move(value);
}

// Throws Error with the sentence at the place of the key's value, or of the table where it has no such key.
[[noreturn]] void fail_at_key(const TomlTable& table, std::string_view key, std::string_view sentence);
[[noreturn]] void fail_at_table(const TomlTable& table, std::string_view sentence);

// Throws Error at element `index` of the array under the key.
[[noreturn]] void fail_at_element(const TomlTable& table, std::string_view key, std::size_t index,
                                  std::string_view sentence);

// For writers: a text with its quotes; a number that reads back to the same double; a local date-time.
std::string toml_quoted(std::string_view text);
std::string toml_number(double number);
std::string toml_local_time(std::int64_t local_time_s);

}  // namespace ballbar
