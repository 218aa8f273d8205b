#include "page/tool_page.hpp"

#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <string>
#include <system_error>

#include "ballbar/error.hpp"
#include "ballbar/formats/text/file_bytes.hpp"

namespace ballbar {
namespace {

namespace fs = std::filesystem;

// Beside the program as it is installed, and as it lies in the tree where it is built.
constexpr std::array kPlaces{"../share/ballbar/ballbar.html", "../../build-tool/ballbar.html"};

fs::path tool_page() {
  std::error_code unknown;
  const fs::path program = fs::read_symlink("/proc/self/exe", unknown);
  for (const char* place : kPlaces) {
    const fs::path file = (program.parent_path() / place).lexically_normal();
    if (fs::is_regular_file(file, unknown)) return file;
  }
  throw Error(
      fmt::format("--tool: expected {} beside the program, found none: this ballbar was built without it; "
                  "sh apps/page/build-tool.sh makes it (Debian's emscripten, some minutes).",
                  (program.parent_path() / kPlaces.front()).lexically_normal().string()));
}

}  // namespace

void write_tool_page(const std::string& out) {
  const fs::path from = tool_page();
  const std::string bytes = read_bytes(from.string(), kLargestText);
  write_bytes(out, bytes);
  fmt::print("{}, {:.1f} MB: open it in a browser and drop files on it. It needs no network and no installation.\n",
             out, 1e-6 * static_cast<double>(bytes.size()));
}

}  // namespace ballbar
