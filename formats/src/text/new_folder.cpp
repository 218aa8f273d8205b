#include "ballbar/formats/text/new_folder.hpp"

#include <fmt/format.h>

#include <random>
#include <system_error>

#include "ballbar/error.hpp"
#include "ballbar/formats/text/file_bytes.hpp"

namespace ballbar {

namespace fs = std::filesystem;

void expect_new_folder(const fs::path& folder) {
  std::error_code error;
  if (!fs::exists(folder, error)) return;
  if (!fs::is_directory(folder, error)) {
    throw Error(fmt::format("{}: expected a new or an empty folder, found a file.", folder.string()));
  }
  if (!fs::is_empty(folder, error)) {
    throw Error(fmt::format("{}: expected a new or an empty folder, found one that holds files.", folder.string()));
  }
}

fs::path new_folder_beside(const fs::path& folder) {
  std::random_device random;
  for (int attempt = 0;; ++attempt) {
    // Hidden: whoever reads the folder around it meanwhile does not read half of it.
    const fs::path name = folder.parent_path() / fmt::format(".{}.{:08x}", folder.filename().string(), random());
    std::error_code error;
    if (fs::create_directories(name, error)) return name;
    if (error || attempt == 100) {
      throw Error(fmt::format("{}: expected a folder that can be made, found: {}.", folder.string(),
                              error ? error.message() : "no free name"));
    }
  }
}

fs::path folder_to_write(const fs::path& folder) {
  if (folder.empty()) throw Error("Expected the name of a folder to write to, found an empty one.");
  return fs::absolute(folder / "").lexically_normal().parent_path();
}

void write_folder(const fs::path& folder, const std::vector<std::pair<std::string, std::string>>& files) {
  const fs::path target = folder_to_write(folder);
  expect_new_folder(folder);
  const fs::path temporary = new_folder_beside(target);
  std::error_code ignored;
  try {
    for (const auto& [name, bytes] : files) {
      fs::create_directories((temporary / name).parent_path());
      write_bytes(temporary / name, bytes);
    }
    fs::remove(target);  // an empty one
    fs::rename(temporary, target);
  } catch (const fs::filesystem_error& failed) {
    fs::remove_all(temporary, ignored);
    throw Error(fmt::format("{}: expected a folder to write to, found: {}.", folder.string(), failed.code().message()));
  } catch (...) {
    fs::remove_all(temporary, ignored);
    throw;
  }
}

}  // namespace ballbar
