// A sheet of a workbook, .xlsx (ECMA-376), as lines of text. In a build without libzip (BALLBAR_XLSX=OFF) reading
// throws an Error that says what to install.
#pragma once

#include <string>
#include <string_view>

#include "logs/log_sources.hpp"

namespace ballbar {

bool is_workbook(std::string_view head);  // by its first bytes: a zip archive

// `sheet`: its name, or its number from 1; empty: the first. Cells are taken as the values they show: a formula by what
// was stored of it, dates and percentages by their formats; links to other files are never followed. Throws Error: no
// workbook, no such sheet, above 256 MiB when unpacked.
TableText workbook_table(std::string_view bytes, const std::string& name, const std::string& sheet);

}  // namespace ballbar
