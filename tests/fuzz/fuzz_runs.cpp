// Any bytes: read_runs returns or throws Error, nothing else; no file of what it returns leaves the folder.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "ballbar/error.hpp"
#include "ballbar/formats/models/runs_csv.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const ballbar::RunList list =
        ballbar::read_runs(std::string_view(reinterpret_cast<const char*>(data), size), "fuzz");
    for (const ballbar::ListedRun& run : list.runs) {
      const std::filesystem::path normal = run.file.lexically_normal();
      if (normal.is_absolute() || normal.empty() || *normal.begin() == "..") std::abort();
      if (run.about.size() != list.columns.size()) std::abort();
    }
  } catch (const ballbar::Error&) {
  }
  return 0;
}
