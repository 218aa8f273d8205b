#include "ballbar/formats/results/schema.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "ballbar/error.hpp"

namespace ballbar {
namespace {

std::string typescript_type(const ValueSchema& value) {
  const auto plain = [&]() -> std::string {
    switch (value.kind) {
      case ValueKind::number:
        return "Num";
      case ValueKind::known:
      case ValueKind::whole:
        return "number";
      case ValueKind::truth:
        return "boolean";
      case ValueKind::text:
        return "string";
      case ValueKind::list: {
        const std::string of = typescript_type(value.of.front());
        return of.find(' ') == std::string::npos ? of + "[]" : fmt::format("({})[]", of);
      }
      case ValueKind::table:
        return fmt::format("Record<string, {}>", typescript_type(value.of.front()));
      case ValueKind::result:
        return value.name;
      case ValueKind::one_of: {
        std::vector<std::string> types;
        for (const ValueSchema& one : value.of) types.push_back(typescript_type(one));
        return fmt::format("{}", fmt::join(types, " | "));
      }
    }
    return "unknown";
  };
  return value.or_null && value.kind != ValueKind::number ? plain() + " | null" : plain();
}

// The key with its type. TypeScript lets a key of any name hold what all others of the result hold, too.
std::string typescript_key(const FieldSchema& field) {
  switch (field.key) {
    case KeyKind::always:
      return fmt::format("{}: {}", field.name, typescript_type(field.value));
    case KeyKind::may_lack:
      return fmt::format("{}?: {}", field.name, typescript_type(field.value));
    case KeyKind::with_unit:
      return fmt::format("[key: `{}_${{string}}`]: {}", field.name, typescript_type(field.value));
    case KeyKind::made:
      return "[key: string]: unknown";
  }
  return field.name;
}

}  // namespace

bool add_name(std::vector<ResultSchema>& all, ResultSchema schema) {
  for (const ResultSchema& one : all) {
    if (one.of == schema.of) return false;
    if (one.name == schema.name) throw Error(one.name + ": expected one type of that name, found two.");
  }
  all.push_back(std::move(schema));
  return true;
}

void add_field(std::vector<FieldSchema>& fields, FieldSchema field) {
  const auto same = std::find_if(fields.begin(), fields.end(),
                                 [&](const FieldSchema& one) { return key_text(one) == key_text(field); });
  same == fields.end() ? fields.push_back(std::move(field)) : void(*same = std::move(field));
}

std::string key_text(const FieldSchema& field) {
  return field.key == KeyKind::with_unit ? field.name + "_UNIT" : field.name;
}

std::string typescript_of(const std::vector<ResultSchema>& schemas) {
  std::string text;
  for (const ResultSchema& schema : schemas) {
    text += fmt::format("// {}\nexport interface {} {{\n", schema.meaning, schema.name);
    for (const FieldSchema& field : schema.fields) {
      text += fmt::format("  {};{}\n", typescript_key(field), field.meaning.empty() ? "" : " // " + field.meaning);
    }
    text += "}\n\n";
  }
  return text;
}

std::string markdown_of(const ResultSchema& schema) {
  std::string text = "| key | holds |\n|---|---|\n";
  for (const FieldSchema& field : schema.fields) text += fmt::format("| `{}` | {} |\n", key_text(field), field.meaning);
  return text;
}

}  // namespace ballbar
