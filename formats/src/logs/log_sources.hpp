// Converts tables that are not text (workbooks, MATLAB files, JSON) to lines of text with tabs, so that one reader
// reads all of them.
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
  std::vector<std::string> sheets;  // all of the workbook
};

// In one cell: no tab, no line end, no quote.
std::string as_cell(std::string_view text);

// The vectors of a MATLAB file (.mat v5 to v7.3), read with matio; in a build without it (BALLBAR_MAT=OFF) an Error
// states what to install. Takes numeric vectors and matrices, also in structs, of the most common length. A matrix
// gives several columns, named by a cell array of as many texts if there is one. The file is read in a separate
// process, so that a damaged file cannot crash this one. Throws Error.
TableText mat_table(std::string_view bytes, const std::string& name);

// A sheet of a workbook, .xlsx (ECMA-376); in a build without libzip (BALLBAR_XLSX=OFF) an Error says what to install.
// `sheet`: its name, or its number from 1. Cells are taken as the values they
// show: a formula by what was stored of it, dates and percentages by their formats; links to other files are never
// followed. Throws Error: no workbook, no such sheet, above 256 MiB when unpacked.
TableText workbook_table(std::string_view bytes, const std::string& name, const std::string& sheet);

// As sheets_of. Throws as workbook_table.
WorkbookSheets workbook_sheets(std::string_view bytes, const std::string& name);

// As workbook_table, of each sheet; those that are empty have no text.
std::vector<TableText> workbook_tables(std::string_view bytes, const std::string& name);

bool is_table_file(std::string_view head);  // by its first bytes

// Returns nullopt for formats that is_table_file() does not recognise. Throws Error.
std::optional<TableText> table_text(std::string_view bytes, const std::string& name, const LogRecipe& recipe);

}  // namespace ballbar
