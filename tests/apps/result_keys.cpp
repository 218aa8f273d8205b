// Holds what is written of the results' lists of fields to these lists: apps/page/src/results.ts, and the tables of
// keys in READMEs, which stand between the lines `<!-- keys of NAME -->` and `<!-- end of keys -->`.
//
//   result_keys FOLDER [--update]     FOLDER: of the sources; --update writes what differs anew
#include <fmt/core.h>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ballbar/formats/results/schema.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "diagnose/diagnosis_result.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kLargest = 1 << 22;

std::string typescript_file(const std::vector<ResultSchema>& schemas) {
  return "// Results of the program: the keys of its `--json`. Written by tests/apps/result_keys from their lists of "
         "fields.\n\nexport type Num = number | null; // null: not known\n\n" +
         typescript_of(schemas);
}

// A page with the tables of its marks anew.
std::string with_tables(std::string page, const std::vector<ResultSchema>& schemas) {
  constexpr std::string_view kBegin = "<!-- keys of ", kEnd = "<!-- end of keys -->";
  std::size_t at = 0;
  while ((at = page.find(kBegin, at)) != std::string::npos) {
    const std::size_t name = at + kBegin.size(), line = page.find('\n', at), end = page.find(kEnd, at);
    const std::string wanted = page.substr(name, page.find(" -->", name) - name);
    const auto schema =
        std::find_if(schemas.begin(), schemas.end(), [&](const ResultSchema& one) { return one.name == wanted; });
    if (schema != schemas.end() && end != std::string::npos)
      page.replace(line + 1, end - line - 1, "\n" + markdown_of(*schema) + "\n");
    at = line;
  }
  return page;
}

int run(const std::filesystem::path& folder, bool update) {
  std::vector<ResultSchema> schemas;
  add_schema<DiagnosisReport>(schemas);
  add_schema<ResidualReport>(schemas);
  std::vector<std::pair<std::filesystem::path, std::string>> files{
      {folder / "apps/page/src/results.ts", typescript_file(schemas)}};
  for (const char* page : {"apps/diagnose/README.md", "apps/model/README.md"})
    files.emplace_back(folder / page, with_tables(read_bytes(folder / page, kLargest), schemas));
  int status = 0;
  for (const auto& [path, text] : files) {
    if (std::filesystem::exists(path) && read_bytes(path, kLargest) == text) continue;
    if (update) {
      write_bytes(path, text);
    } else {
      fmt::print("{} differs from the fields of the results: result_keys FOLDER --update\n", path.string());
      status = 1;
    }
  }
  return status;
}

}  // namespace
}  // namespace ballbar

int main(int argc, char** argv) {
  try {
    return ballbar::run(argc > 1 ? argv[1] : ".", argc > 2 && std::string_view(argv[2]) == "--update");
  } catch (const std::exception& error) {
    fmt::print("{}\n", error.what());
    return 2;
  }
}
