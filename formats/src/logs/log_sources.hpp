// Files that hold a table but are no text: workbooks, MATLAB's files, JSON. They become lines of text with tabs, so
// that all of them are read by one reader.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "ballbar/formats/logs/log.hpp"

namespace ballbar {

inline constexpr std::size_t kMostColumns = 10000;  // of a log, whatever its file

struct TableText {
  std::string text;   // UTF-8: tabs between cells, decimal points, dates as ISO 8601; line k is row k of the file
  std::string name;   // for messages: "log.xlsx[Sheet1]"
  std::string shape;  // in words: "a workbook, sheet \"Sheet1\""
  std::string sheet;
};

// In one cell: no tab, no line end, no quote.
std::string as_cell(std::string_view text);

bool is_table_file(std::string_view head);  // by its first bytes

// Nullopt for all that is_table_file does not know. Throws Error.
std::optional<TableText> table_text(std::string_view bytes, const std::string& name, const LogRecipe& recipe);

}  // namespace ballbar
