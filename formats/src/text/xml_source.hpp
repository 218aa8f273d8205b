// XML as checked values. Every error is one sentence with its place. No DTD, no entities of its own.
#pragma once

#include <cstddef>
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

// Calls use(number, its text) for each of the numbers between blanks, in order; returns how many there are.
template <class Use>
std::size_t each_number(const SourceText& text, const Text& found, std::string_view name, Use use) {
  const char* const begin = found.value.data();
  const char* const end = begin + found.value.size();
  std::size_t count = 0;
  for (const char* at = begin; at != end; ++count) {  // trimmed: it begins with a number
    const char* last = at;
    while (last != end && !is_xml_blank(*last)) ++last;
    const Text one{{at, static_cast<std::size_t>(last - at)}, found.offset + static_cast<std::size_t>(at - begin)};
    use(number_of(text, one, name), one);
    for (at = last; at != end && is_xml_blank(*at);) ++at;
  }
  return count;
}

// Of the child of that name.
double positive_in(const SourceText& text, pugi::xml_node parent, const char* name);
std::optional<double> optional_number_in(const SourceText& text, pugi::xml_node parent, const char* name);
double angle_in(const SourceText& text, pugi::xml_node parent, const char* name);       // deg, at most ten turns
std::size_t index_in(const SourceText& text, pugi::xml_node parent, const char* name);  // from 0

}  // namespace ballbar
