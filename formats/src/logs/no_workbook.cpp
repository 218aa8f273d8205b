// In place of workbook.cpp where ballbar is built without libzip.
#include <fmt/format.h>

#include "ballbar/error.hpp"
#include "logs/log_sources.hpp"

namespace ballbar {

std::vector<TableText> workbook_tables(std::string_view bytes, const std::string& name) {
  return {workbook_table(bytes, name, {})};
}

TableText workbook_table(std::string_view, const std::string& name, const std::string&) {
  throw Error(
      fmt::format("{}:1: expected a ballbar that can read workbooks, found one built without libzip. Install "
                  "libzip-dev, configure with -D BALLBAR_XLSX=ON and build again, or export the sheet as text.",
                  name));
}

}  // namespace ballbar
