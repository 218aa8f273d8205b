// Where a table of a TOML file stands in its text: for edits that leave the rest as it is.
#pragma once

#include <algorithm>
#include <string_view>

#include "text/toml_source.hpp"

namespace ballbar {

// Offset of the line on which a table starts. `text`: what was parsed.
inline std::size_t line_start(std::string_view text, const TomlTable& table) {
  std::size_t at = 0;
  for (auto line = table.table->source().begin.line; line > 1; --line) at = text.find('\n', at) + 1;
  return at;
}

// The same with the comments directly above it.
inline std::size_t start_with_comments(std::string_view text, const TomlTable& table) {
  std::size_t at = line_start(text, table);
  while (at > 0) {
    const std::size_t before = text.substr(0, at - 1).rfind('\n') + 1;
    if (text[before] != '#') break;
    at = before;
  }
  return at;
}

// [[name]] on a line of its own, not { } in an array.
inline bool has_header(std::string_view text, const TomlTable& table) {
  std::string_view line = text.substr(line_start(text, table));
  line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
  return line.starts_with("[[");
}

inline bool is_before(const TomlTable& left, const TomlTable& right) {
  return left.table->source().begin.line < right.table->source().begin.line;
}

}  // namespace ballbar
