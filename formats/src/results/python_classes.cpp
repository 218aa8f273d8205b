#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <regex>
#include <utility>

#include "ballbar/error.hpp"
#include "ballbar/formats/results/schema.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kWidth = 118;
// Of the keys of results; one that is a word of Python is had as result["from"].
constexpr std::array<std::string_view, 4> kWordsOfPython{"from", "with", "in", "is"};

const ResultSchema& schema_of(const std::vector<ResultSchema>& schemas, const std::string& name) {
  const auto at =
      std::find_if(schemas.begin(), schemas.end(), [&](const ResultSchema& one) { return one.name == name; });
  if (at == schemas.end()) throw Error(fmt::format("{}: expected a type of results, found none.", name));
  return *at;
}

std::string python_type(const ValueSchema& value);

std::string type_of_list(const ValueSchema& of) {
  const ValueSchema& inner = of.kind == ValueKind::list ? of.of.front() : of;  // a matrix is an array too
  if (inner.kind == ValueKind::number || inner.kind == ValueKind::known || inner.kind == ValueKind::whole)
    return "Array";
  if (of.kind == ValueKind::result) return fmt::format("Rows[{}]", of.name);
  if (of.kind == ValueKind::one_of) return "Rows[Result]";
  return of.kind == ValueKind::text ? "list[str]" : "list[Any]";
}

std::string python_type(const ValueSchema& value) {
  const auto plain = [&]() -> std::string {
    switch (value.kind) {
      case ValueKind::number:
      case ValueKind::known:
        return "float";
      case ValueKind::whole:
        return "int";
      case ValueKind::truth:
        return "bool";
      case ValueKind::text:
        return "str";
      case ValueKind::list:
        return type_of_list(value.of.front());
      case ValueKind::result:
        return value.name;
      default:
        return "Result";
    }
  };
  return value.or_null ? plain() + " | None" : plain();
}

// Lines of at most kWidth signs.
std::string wrapped(const std::string& text, const std::string& indent) {
  std::string lines, line = indent;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    const std::string word = text.substr(at, end - at);
    if (line.size() > indent.size() && line.size() + 1 + word.size() > kWidth) {
      lines += line + "\n";
      line = indent;
    }
    line += (line.size() > indent.size() ? " " : "") + word;
    at = end + 1;
  }
  return line.size() > indent.size() ? lines + line + "\n" : lines;
}

constexpr std::array<std::pair<std::string_view, std::string_view>, 21> kUnits{
    {{"_um_per_m", "um/m"}, {"_mm_per_min", "mm/min"},
     {"_um_per_K", "um/K"}, {"_um", "um"},
     {"_mm", "mm"},         {"_deg", "deg"},
     {"_urad", "urad"},     {"_rad", "rad"},
     {"_degC", "degC"},     {"_rpm", "rpm"},
     {"_min", "min"},       {"_ms", "ms"},
     {"_s", "s"},           {"_K", "K"},
     {"_h", "h"},           {"_percent", "%"},
     {"_W", "W"},           {"_A", "A"},
     {"_Nm", "Nm"},         {"_V", "V"},
     {"_ppm", "um/m"}}};

const std::regex kNull("\\bnull\\b");  // as Python has it

// The result that a value, or each of its rows, is; empty: none.
std::string part_of(const ValueSchema& value) {
  if (value.kind == ValueKind::result) return value.name;
  return value.of.empty() || value.kind == ValueKind::one_of ? "" : part_of(value.of.front());
}

// The meaning and the unit of a key; where no meaning is stated, that of its part, else the words of its name.
std::string meaning_of(const FieldSchema& field, const std::vector<ResultSchema>& schemas) {
  const std::string part = part_of(field.value);
  std::string words = field.meaning.empty() && !part.empty() ? schema_of(schemas, part).meaning : field.name, unit;
  for (const auto& [ending, text] : kUnits) {
    if (!words.ends_with(ending) || field.value.kind == ValueKind::text) continue;
    unit = fmt::format(", {}", text);
    words.erase(words.size() - ending.size());
    break;
  }
  std::replace(words.begin(), words.end(), '_', ' ');
  std::string text = std::regex_replace(field.meaning.empty() ? words : field.meaning, kNull, "None");
  text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
  if (text.back() == '.') text.pop_back();
  return text + unit + ".";
}

struct Attribute {
  FieldSchema field;
  std::string type;
};

void add_keys(std::vector<Attribute>& attributes, const ResultSchema& schema) {
  for (const FieldSchema& field : schema.fields) {
    const std::string type = python_type(field.value);
    const auto same = [&](const Attribute& one) { return one.field.name == field.name; };
    const auto known = std::find_if(attributes.begin(), attributes.end(), same);
    if (known == attributes.end()) {
      attributes.push_back({field, type});
    } else if ((" | " + known->type + " | ").find(" | " + type + " | ") == std::string::npos) {
      known->type += " | " + type;
    }
  }
}

std::vector<Attribute> attributes_of(const PythonClass& of, const std::vector<PythonClass>& classes,
                                     const std::vector<ResultSchema>& schemas) {
  std::vector<Attribute> attributes;
  for (const std::string& name : of.results) add_keys(attributes, schema_of(schemas, name));
  const auto base =
      std::find_if(classes.begin(), classes.end(), [&](const PythonClass& one) { return one.name == of.base; });
  if (base == classes.end()) return attributes;
  std::vector<Attribute> had;
  for (const std::string& name : base->results) add_keys(had, schema_of(schemas, name));
  std::erase_if(attributes, [&](const Attribute& attribute) {
    return std::any_of(had.begin(), had.end(),
                       [&](const Attribute& one) { return one.field.name == attribute.field.name; });
  });
  return attributes;
}

bool is_attribute(const FieldSchema& field) {
  return (field.key == KeyKind::always || field.key == KeyKind::may_lack) &&
         std::find(kWordsOfPython.begin(), kWordsOfPython.end(), field.name) == kWordsOfPython.end();
}

// Classes for the parts of results too, each once, before those that have them.
void add_parts(const ValueSchema& value, const std::vector<ResultSchema>& schemas, std::vector<PythonClass>& classes) {
  for (const ValueSchema& of : value.of) add_parts(of, schemas, classes);
  if (value.kind != ValueKind::result) return;
  const auto same = [&](const PythonClass& one) { return one.name == value.name; };
  if (std::any_of(classes.begin(), classes.end(), same)) return;
  classes.push_back({value.name, "", {value.name}});
  for (const FieldSchema& field : schema_of(schemas, value.name).fields) add_parts(field.value, schemas, classes);
}

}  // namespace

std::string python_of(const std::vector<PythonClass>& of, const std::vector<ResultSchema>& schemas) {
  std::vector<PythonClass> classes = of;
  for (const PythonClass& one : of) {
    for (const std::string& name : one.results) {
      for (const FieldSchema& field : schema_of(schemas, name).fields) add_parts(field.value, schemas, classes);
    }
  }
  std::string text;
  for (const PythonClass& one : classes) {
    std::string meaning = schema_of(schemas, one.results.front()).meaning;
    meaning.pop_back();  // the full stop
    if (!one.function.empty()) meaning += fmt::format(", :func:`ballbar.{}`", one.function);
    std::string keys, annotations;
    bool is_open = false;  // to keys that are known once a result is made
    for (const Attribute& attribute : attributes_of(one, classes, schemas)) {
      is_open = is_open || attribute.field.key == KeyKind::with_unit || attribute.field.key == KeyKind::made;
      keys += fmt::format("    {} : {}\n{}", key_text(attribute.field), attribute.type,
                          wrapped(meaning_of(attribute.field, schemas), "        "));
      if (is_attribute(attribute.field))
        annotations += fmt::format("    {}: {}\n", attribute.field.name, attribute.type);
    }
    if (is_open || annotations.empty()) annotations += fmt::format("    _is_open = {}\n", is_open ? "True" : "False");
    text += fmt::format("\n\nclass {}({}):\n    \"\"\"{}.\n\n    Attributes\n    ----------\n{}    \"\"\"\n\n{}",
                        one.name, one.base, meaning, keys, annotations);
  }
  return text;
}

}  // namespace ballbar
