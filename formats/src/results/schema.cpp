#include "ballbar/formats/results/schema.hpp"

#include <fmt/format.h>

namespace ballbar {
namespace {

std::string typescript_type(const ValueSchema& value) {
  const auto plain = [&]() -> std::string {
    switch (value.kind) {
      case ValueKind::number:
        return "Num";
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
    }
    return "unknown";
  };
  return value.or_null && value.kind != ValueKind::number ? plain() + " | null" : plain();
}

}  // namespace

std::string typescript_of(const std::vector<ResultSchema>& schemas) {
  std::string text;
  for (const ResultSchema& schema : schemas) {
    text += fmt::format("// {}\nexport interface {} {{\n", schema.meaning, schema.name);
    for (const FieldSchema& field : schema.fields) {
      text += fmt::format("  {}{}: {};{}\n", field.name, field.may_lack ? "?" : "", typescript_type(field.value),
                          field.meaning.empty() ? "" : " // " + field.meaning);
    }
    text += "}\n\n";
  }
  return text;
}

std::string markdown_of(const ResultSchema& schema) {
  std::string text = "| key | holds |\n|---|---|\n";
  for (const FieldSchema& field : schema.fields) text += fmt::format("| `{}` | {} |\n", field.name, field.meaning);
  return text;
}

}  // namespace ballbar
