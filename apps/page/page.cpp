// `ballbar page`: the page that is the whole tool, as a file to pass on.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>

#include "ballbar/error.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "commands.hpp"
#include "terminal/option_checks.hpp"
#include "terminal/stderr_line.hpp"

namespace ballbar::commands {
namespace {

namespace fs = std::filesystem;

// Beside the program as it is installed, and as it lies in the tree where it is built.
constexpr std::array kPlaces{"../share/ballbar/ballbar.html", "../../build-tool/ballbar.html"};

fs::path carried_page() {
  std::error_code unknown;
  const fs::path program = fs::read_symlink("/proc/self/exe", unknown);
  for (const char* place : kPlaces) {
    const fs::path file = (program.parent_path() / place).lexically_normal();
    if (fs::is_regular_file(file, unknown)) return file;
  }
  throw Error(
      fmt::format("page: expected {} beside the program, found none: this ballbar was built without it; "
                  "sh apps/page/build-tool.sh makes it (Debian's emscripten, some minutes).",
                  (program.parent_path() / kPlaces.front()).lexically_normal().string()));
}

void run(const std::string& out) {
  const fs::path from = carried_page();
  const std::string bytes = read_bytes(from.string(), kLargestText);
  write_bytes(out, bytes);
  fmt::print("{}, {:.1f} MB: open it in a browser and drop files on it. It needs no network and no installation.\n",
             out, 1e-6 * static_cast<double>(bytes.size()));
}

}  // namespace

void add_page(CLI::App& app) {
  const auto out = std::make_shared<std::string>("ballbar.html");
  CLI::App* command = app.add_subcommand("page", "Write the whole tool as one HTML file, for any computer");
  command->add_option("--out", *out, "where to; default: ballbar.html")
      ->type_name("FILE.html")
      ->check(name_that_ends_in({".html"}));
  command->footer(
      "Example:\n"
      "  ballbar page --out ballbar.html");
  command->callback([out] { run(*out); });
}

}  // namespace ballbar::commands
