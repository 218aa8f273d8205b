// In place of mat_table.cpp where ballbar is built without matio.
#include <fmt/format.h>

#include "ballbar/error.hpp"
#include "logs/log_sources.hpp"

namespace ballbar {

TableText mat_table(std::string_view, const std::string& name) {
  throw Error(
      fmt::format("{}:1: expected a ballbar that can read .mat files, found one built without matio. Install "
                  "libmatio-dev, configure with -D BALLBAR_MAT=ON and build again.",
                  name));
}

}  // namespace ballbar
