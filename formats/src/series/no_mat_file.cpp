// In place of mat_file.cpp where ballbar is built without matio.
#include <fmt/format.h>

#include "ballbar/error.hpp"
#include "series/mat_file.hpp"

namespace ballbar {

void expect_mat(const std::filesystem::path& path) {
  throw Error(
      fmt::format("{}: expected a ballbar that can write .mat files, found one built without matio. Install "
                  "libmatio-dev, configure with -D BALLBAR_MAT=ON and build again.",
                  path.string()));
}

void write_mat(std::string_view, double, const Series&, const std::filesystem::path& path) { expect_mat(path); }

}  // namespace ballbar
