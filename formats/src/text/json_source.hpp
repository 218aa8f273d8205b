// JSON text as checked values. Every error is one sentence: the file and, where the text is no JSON, line and column,
// else the path of the value, its elements counted from 0: "trained_range.mean_degC[3]".
//
//   const JsonSource source = parse_json(bytes, name);
//   const JsonValue root = root_of(source);
//   expect_keys(root, {"target", "slopes"});
//   const std::string target = text(member(root, "target"));
//
// A getter throws Error where the value is of another kind; what is absent is an error too.
#pragma once

#include <Eigen/Core>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace ballbar {

struct JsonSource {
  nlohmann::json root;
  std::string name;  // stands in messages
};

// One value of a source, which must outlive it.
struct JsonValue {
  const nlohmann::json* value = nullptr;
  const JsonSource* source = nullptr;
  std::string path;  // empty for the root
};

// Throws Error: not UTF-8, not JSON, a number too large for a double, a key twice in an object, more than 20 levels,
// more than 4 million values. A byte order mark is skipped.
JsonSource parse_json(std::string_view bytes, std::string_view name);

JsonValue root_of(const JsonSource& source);
JsonValue root_of(JsonSource&&) = delete;

// Exactly these keys, in any order. Throws Error: no object, another key (with the nearest), a key missing.
void expect_keys(const JsonValue& object, std::initializer_list<std::string_view> known);

// Throws Error where the object lacks the key.
JsonValue member(const JsonValue& object, std::string_view key);

double number(const JsonValue& value);  // finite; integers too
double number_not_below_0(const JsonValue& value);
std::size_t whole(const JsonValue& value, std::size_t low, std::size_t high);
std::string text(const JsonValue& value);  // not empty, no control character but tab
// Position of the value's text in `names`, which are the only ones accepted.
std::size_t choice_index(const JsonValue& value, std::initializer_list<std::string_view> names);

std::size_t size_of_array(const JsonValue& value);
JsonValue element(const JsonValue& array, std::size_t index);
// `count` finite numbers; `why` says why so many: "one for each input".
Eigen::VectorXd numbers(const JsonValue& value, std::size_t count, std::string_view why);

// Throws Error "name: expected {expected} at {path}, found" the value.
[[noreturn]] void fail(const JsonValue& value, std::string_view expected);
// The same with what was found.
[[noreturn]] void fail(const JsonValue& value, std::string_view expected, std::string_view found);

}  // namespace ballbar
