// In place of mat_table.cpp where ballbar is built without matio.
#include <fmt/format.h>

#include "ballbar/error.hpp"
#include "logs/mat_table.hpp"

namespace ballbar {

bool is_mat_file(std::string_view head) {
  return head.starts_with("MATLAB 5.0 MAT-file") || head.starts_with("MATLAB 7.3 MAT-file");
}

TableText mat_table(std::string_view, const std::string& name) {
  throw Error(
      fmt::format("{}:1: expected a ballbar that can read .mat files, found one built without matio; install "
                  "libmatio-dev, configure "
                  "with -D BALLBAR_MAT=ON and build again.",
                  name));
}

}  // namespace ballbar
