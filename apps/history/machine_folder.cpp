#include "history/machine_folder.hpp"

#include <regex>
#include <string>

namespace ballbar {
namespace {

const char* const kYear = "(19|20)[0-9]{2}";
const char* const kMonth = "(0?[1-9]|1[0-2])";
const char* const kDay = "(0?[1-9]|[12][0-9]|3[01])";

// What follows the date, after a sign, is of the test: "2025-01-20 after crash".
bool is_date(const std::string& name) {
  static const std::string rest = "([^0-9A-Za-z].*|[T_-].*)?", between = "[-_. ]";
  static const std::regex whole(std::string("(") + kYear + between + kMonth + "(" + between + kDay +
                                ")?|" +                                                   // 2025-01-20
                                kYear + "(0[1-9]|1[0-2])(0[1-9]|[12][0-9]|3[01])|" +      // 20250120
                                kYear + between + "?(W|KW|Q|w|kw|q)[0-9]{1,2}|" +         // 2025-W03
                                kDay + between + kMonth + between + kYear + ")" + rest);  // 20.1.2025
  return std::regex_match(name, whole);
}

bool is_year(const std::string& name) {
  static const std::regex year(kYear);
  return std::regex_match(name, year);
}

}  // namespace

std::filesystem::path machine_folder(std::filesystem::path folder) {
  bool is_below_date = false;
  while (folder.has_filename()) {
    const std::string name = folder.filename().string();
    const bool is_of_test = is_date(name) || (is_below_date && is_year(name));
    if (!is_of_test) break;
    is_below_date = true;
    folder = folder.parent_path();
  }
  return folder;
}

}  // namespace ballbar
