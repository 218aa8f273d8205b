#include "text/path_inside.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "ballbar/error.hpp"

namespace ballbar {

namespace fs = std::filesystem;

bool stays_inside(const std::string& path) {
  const fs::path normal = fs::path(path).lexically_normal();
  return !path.empty() && path.find('\0') == std::string::npos && !normal.is_absolute() && normal != "." &&
         *normal.begin() != "..";
}

fs::path path_inside(const fs::path& folder, const std::string& file, std::string_view owner) {
  std::error_code error;
  const fs::path root = fs::weakly_canonical(folder, error);
  const fs::path target = error ? fs::path() : fs::weakly_canonical(folder / file, error);
  const auto [end, rest] = std::mismatch(root.begin(), root.end(), target.begin(), target.end());
  if (error || end != root.end()) {
    throw Error(fmt::format("{}: expected a file inside {}'s folder, found a link or path that leaves it.",
                            (folder / file).string(), owner));
  }
  return folder / file;
}

}  // namespace ballbar
