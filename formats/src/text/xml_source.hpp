// XML as checked values. Every error is one sentence with its place. No DTD, no entities of its own.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <pugixml.hpp>
#include <string_view>

#include "text/located_text.hpp"

namespace ballbar {

inline constexpr std::string_view kBlank = " \t\r\n";

// Text of an element, trimmed, and where it stands.
struct Text {
  std::string_view value;
  std::size_t offset = 0;
};

// Throws Error at a fault, an entity that XML does not define itself, or a document type.
void parse_xml(const SourceText& text, pugi::xml_document& document);

// Where the name of the element stands; 0 of a null node.
std::size_t offset_of(pugi::xml_node node);

// The child of that name. Throws Error where there are several, or where it is needed and missing.
pugi::xml_node child_of(const SourceText& text, pugi::xml_node parent, const char* name, bool needed = true);

// Empty for an empty or a null element. Throws Error where there are elements inside.
Text text_of(const SourceText& text, pugi::xml_node node);

// A finite number; `name` stands in the message.
double number_of(const SourceText& text, const Text& found, std::string_view name);

constexpr bool is_xml_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

// A number such as +0.05212 at the beginning of a text, and what follows it; `rest` null where there is none such.
struct PlainDecimal {
  double value = 0.0;
  const char* rest = nullptr;
};

// A file has thousands of them. Exact: up to 15 digits and the power of ten that they are divided by are whole in a
// double, so that the quotient is rounded once, as from_chars rounds.
inline PlainDecimal plain_decimal(const char* at, const char* end) {
  constexpr double kPowers[] = {1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};
  const bool negative = at != end && *at == '-';
  if (at != end && (*at == '-' || *at == '+')) ++at;
  std::int64_t whole = 0;
  std::ptrdiff_t digits = 0, decimals = 0;
  const auto take_digits = [&] {
    const char* const first = at;
    for (; at != end && *at >= '0' && *at <= '9' && digits <= 15; ++at, ++digits) whole = whole * 10 + (*at - '0');
    return at - first;
  };
  take_digits();
  if (at != end && *at == '.') {
    ++at;
    decimals = take_digits();
  }
  if (digits == 0 || digits > 15) return {};
  const double value = static_cast<double>(whole) / kPowers[decimals];
  return {negative ? -value : value, at};
}

// Calls use(number, its text) for each of the numbers between blanks, in order; returns how many there are.
template <class Use>
std::size_t each_number(const SourceText& text, const Text& found, std::string_view name, Use use) {
  const char* const begin = found.value.data();
  const char* const end = begin + found.value.size();
  std::size_t count = 0;
  for (const char* at = begin; at != end; ++count) {  // trimmed: it begins with a number
    const PlainDecimal plain = plain_decimal(at, end);
    const bool is_plain = plain.rest != nullptr && (plain.rest == end || is_xml_blank(*plain.rest));
    const char* last = is_plain ? plain.rest : at;
    while (last != end && !is_xml_blank(*last)) ++last;
    const Text one{{at, static_cast<std::size_t>(last - at)}, found.offset + static_cast<std::size_t>(at - begin)};
    use(is_plain ? plain.value : number_of(text, one, name), one);
    for (at = last; at != end && is_xml_blank(*at);) ++at;
  }
  return count;
}

// Of the child of that name.
double positive_in(const SourceText& text, pugi::xml_node parent, const char* name);
double angle_in(const SourceText& text, pugi::xml_node parent, const char* name);       // deg, at most ten turns
std::size_t index_in(const SourceText& text, pugi::xml_node parent, const char* name);  // from 0

}  // namespace ballbar
