#include "text/json_source.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include "ballbar/error.hpp"
#include "text/located_text.hpp"

namespace ballbar {
namespace {

using Json = nlohmann::json;

constexpr std::size_t kDeepest = 20;
constexpr std::size_t kMostValues = 4'000'000;  // 2 bytes of text can be a value of 16 bytes in memory

bool is_plain(std::string_view key) {
  return !key.empty() && key.size() <= 40 && std::all_of(key.begin(), key.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
  });
}

std::string joined(std::string path, std::string_view key) {
  if (!is_plain(key)) return path + fmt::format("[{}]", in_quotes(key));
  if (!path.empty()) path += '.';
  return path.append(key);
}

std::string joined(const std::string& path, std::size_t index) { return fmt::format("{}[{}]", path, index); }

std::string place(std::string_view preposition, const std::string& path) {
  return path.empty() ? "" : fmt::format(" {} {}", preposition, path);
}

// Where what ends at `at` begins: a string in quotes, or a word or number.
std::size_t token_start(std::string_view bytes, std::size_t at, bool whole_string) {
  constexpr std::string_view kOfWords = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_.+-";
  const auto escapes = [&](std::size_t quote) { return quote - (bytes.substr(0, quote).find_last_not_of('\\') + 1); };
  if (whole_string && bytes[at] == '"') {
    std::size_t quote = at;
    do quote = quote == 0 ? std::string_view::npos : bytes.rfind('"', quote - 1);
    while (quote != std::string_view::npos && escapes(quote) % 2 != 0);
    return quote == std::string_view::npos ? at : quote;
  }
  if (kOfWords.find(bytes[at]) == std::string_view::npos) return at;
  return bytes.substr(0, at).find_last_not_of(kOfWords) + 1;  // npos + 1 is 0
}

// Goes through the text before anything is built from it. The parser itself takes the last of two equal keys, any depth
// and any number of values.
class Check {
 public:
  explicit Check(const SourceText& text) : text_(text) {}

  bool null() { return counted(); }
  bool boolean(bool) { return counted(); }
  bool number_integer(Json::number_integer_t) { return counted(); }
  bool number_unsigned(Json::number_unsigned_t) { return counted(); }
  bool number_float(Json::number_float_t, const Json::string_t&) { return counted(); }
  bool string(Json::string_t&) { return counted(); }
  bool binary(Json::binary_t&) { return counted(); }
  bool start_object(std::size_t) { return opened(true); }
  bool start_array(std::size_t) { return opened(false); }
  bool end_object() { return closed(); }
  bool end_array() { return closed(); }

  bool key(Json::string_t& key) {
    Level& level = levels_.back();
    if (!level.keys.insert(key).second) {
      levels_.pop_back();
      throw Error(fmt::format("{}: expected each key once{}, found {} again.", text_.name, place("in", path()),
                              in_quotes(key)));
    }
    level.key = key;
    return true;
  }

  // `at`: how many bytes were read, the last of what does not fit included, and 1 more at the end of the file.
  bool parse_error(std::size_t at, const std::string&, const nlohmann::detail::exception& error) {
    constexpr int kNumberOverflow = 406;
    if (at > text_.bytes.size()) fail_at(text_, text_.bytes.size(), "expected JSON, found the end of the file.");
    const bool whole_string =
        std::string_view(error.what()).find("unexpected string literal") != std::string_view::npos;
    const std::size_t start = token_start(text_.bytes, at == 0 ? 0 : at - 1, whole_string);
    const std::string_view token = text_.bytes.substr(start, text_.bytes.find_first_of(",]}\r\n", start + 1) - start);
    const bool line_end = token.starts_with('\n') || token.starts_with('\r');
    fail_at(
        text_, start,
        fmt::format("expected {}, found {}.", error.id == kNumberOverflow ? "a number that a double can hold" : "JSON",
                    line_end ? "the end of the line" : in_quotes(token)));
  }

 private:
  struct Level {
    bool object = false;
    std::set<std::string> keys;
    std::string key;        // the last one
    std::size_t count = 0;  // elements of an array so far
  };

  // Of what the last level's current value is.
  std::string path() const {
    std::string path;
    for (const Level& level : levels_) path = level.object ? joined(path, level.key) : joined(path, level.count - 1);
    return path;
  }

  bool counted() {
    if (!levels_.empty()) ++levels_.back().count;
    if (++values_ <= kMostValues) return true;
    throw Error(
        fmt::format("{}: expected at most {} values, found more{}.", text_.name, kMostValues, place("at", path())));
  }

  bool opened(bool object) {
    counted();
    if (levels_.size() == kDeepest) {
      throw Error(fmt::format("{}: expected at most {} levels of arrays and objects, found more{}.", text_.name,
                              kDeepest, place("at", path())));
    }
    levels_.push_back({object, {}, {}, 0});
    return true;
  }

  bool closed() {
    levels_.pop_back();
    return true;
  }

  SourceText text_;
  std::vector<Level> levels_;
  std::size_t values_ = 0;
};

std::string found(const Json& value) {
  if (value.is_string()) return "the text " + in_quotes(value.get_ref<const std::string&>());
  if (value.is_number_float()) return fmt::format("the number {}", value.get<double>());
  if (value.is_number_unsigned()) return fmt::format("the integer {}", value.get<std::uint64_t>());
  if (value.is_number_integer()) return fmt::format("the integer {}", value.get<std::int64_t>());
  if (value.is_boolean()) return value.get<bool>() ? "true" : "false";
  return value.is_null() ? "null" : value.is_array() ? "an array" : "an object";
}

// Path and message of an element are made only where one fails: arrays are long.
double finite(const Json& value, double low, const auto& refuse) {
  const double number = value.is_number() ? value.get<double>() : std::numeric_limits<double>::quiet_NaN();
  if (!std::isfinite(number) || number < low) refuse();
  return number;
}

constexpr double kAny = std::numeric_limits<double>::lowest();

}  // namespace

JsonSource parse_json(std::string_view bytes, std::string_view name) {
  const SourceText text = source_text(bytes, name);
  Check check(text);
  Json::sax_parse(text.bytes.begin(), text.bytes.end(), &check);
  return {Json::parse(text.bytes.begin(), text.bytes.end()), std::string(name)};
}

JsonValue root_of(const JsonSource& source) { return {&source.root, &source, ""}; }

void expect_keys(const JsonValue& object, std::initializer_list<std::string_view> known) {
  if (!object.value->is_object()) fail(object, "an object");
  for (const auto& [key, value] : object.value->items()) {
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    throw Error(fmt::format("{}: expected one of the keys {}{}, found {}; the nearest is {}.", object.source->name,
                            fmt::join(known, ", "), place("in", object.path), in_quotes(key),
                            nearest_name(key, {known.begin(), known.size()})));
  }
  for (const std::string_view key : known) member(object, key);
}

JsonValue member(const JsonValue& object, std::string_view key) {
  const auto at = object.value->find(key);
  if (at == object.value->end()) {
    throw Error(
        fmt::format("{}: expected the key {}{}, found none.", object.source->name, key, place("in", object.path)));
  }
  return {&*at, object.source, joined(object.path, key)};
}

double number(const JsonValue& value) {
  return finite(*value.value, kAny, [&] { fail(value, "a number"); });
}

double number_not_below_0(const JsonValue& value) {
  return finite(*value.value, 0.0, [&] { fail(value, "a number not below 0"); });
}

std::size_t whole(const JsonValue& value, std::size_t low, std::size_t high) {
  if (value.value->is_number_unsigned()) {
    const auto number = value.value->get<std::uint64_t>();
    if (number >= low && number <= high) return number;
  }
  fail(value, fmt::format("a whole number from {} to {}", low, high));
}

std::string text(const JsonValue& value) {
  const auto is_control = [](char c) { return (static_cast<unsigned char>(c) < 0x20 && c != '\t') || c == 0x7F; };
  if (value.value->is_string()) {
    const std::string& text = value.value->get_ref<const std::string&>();
    if (!text.empty() && std::none_of(text.begin(), text.end(), is_control)) return text;
  }
  fail(value, "a printable text");
}

std::size_t choice_index(const JsonValue& value, std::initializer_list<std::string_view> names) {
  if (value.value->is_string()) {
    const auto* const name = std::find(names.begin(), names.end(), value.value->get_ref<const std::string&>());
    if (name != names.end()) return static_cast<std::size_t>(name - names.begin());
  }
  fail(value, fmt::format("{}\"{}\"", names.size() > 1 ? "one of " : "", fmt::join(names, "\", \"")));
}

std::size_t size_of_array(const JsonValue& value) {
  if (!value.value->is_array()) fail(value, "an array");
  return value.value->size();
}

JsonValue element(const JsonValue& array, std::size_t index) {
  return {&(*array.value)[index], array.source, joined(array.path, index)};
}

Eigen::VectorXd numbers(const JsonValue& value, std::size_t count, std::string_view why) {
  const std::string expected = fmt::format("an array of {} number{} ({})", count, count == 1 ? "" : "s", why);
  if (!value.value->is_array()) fail(value, expected);
  if (value.value->size() != count) fail(value, expected, fmt::format("an array of {}", value.value->size()));
  Eigen::VectorXd result(static_cast<Eigen::Index>(count));
  for (std::size_t i = 0; i < count; ++i) {
    result[static_cast<Eigen::Index>(i)] =
        finite((*value.value)[i], kAny, [&] { fail(element(value, i), "a number"); });
  }
  return result;
}

void fail(const JsonValue& value, std::string_view expected) { fail(value, expected, found(*value.value)); }

void fail(const JsonValue& value, std::string_view expected, std::string_view found) {
  throw Error(
      fmt::format("{}: expected {}{}, found {}.", value.source->name, expected, place("at", value.path), found));
}

}  // namespace ballbar
