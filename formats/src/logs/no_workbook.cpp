// In place of workbook.cpp where ballbar is built without libzip.
#include <fmt/format.h>

#include "ballbar/error.hpp"
#include "logs/workbook.hpp"

namespace ballbar {

bool is_workbook(std::string_view head) { return head.starts_with("PK\x03\x04"); }

TableText workbook_table(std::string_view, const std::string& name, const std::string&) {
  throw Error(fmt::format(
      "{}:1: expected a ballbar that can read workbooks, found one built without libzip; install libzip-dev, configure "
      "with -D BALLBAR_XLSX=ON and build again, or export the sheet as text.",
      name));
}

}  // namespace ballbar
