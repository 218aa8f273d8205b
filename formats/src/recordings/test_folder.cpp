#include "ballbar/formats/recordings/test_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "ballbar/error.hpp"
#include "ballbar/formats/text/archive.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "ballbar/formats/text/reader.hpp"

namespace ballbar {
namespace {

namespace fs = std::filesystem;

void add_file(FoundFiles& found, const fs::path& path) {
  if (!is_archive(path)) {
    found.files.push_back(path);
    return;
  }
  try {
    for (fs::path& inside : files_in_archive(path)) found.files.push_back(std::move(inside));
  } catch (const Error& error) {
    found.faults.push_back({path.string(), error.what()});
  }
}

void add_folders(FoundFiles& found, std::vector<fs::path> folders) {
  while (!folders.empty()) {
    const fs::path folder = std::move(folders.back());
    folders.pop_back();
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
      std::error_code unknown;
      if (entry->path().filename().string().starts_with('.')) continue;
      if (entry->is_directory(unknown)) {
        if (!entry->is_symlink(unknown)) folders.push_back(entry->path());
      } else if (ends_in(entry->path(), ".b5r") || entry->is_regular_file(unknown)) {
        add_file(found, entry->path());
      }
    }
    if (!error) continue;
    found.faults.push_back(
        {folder.string(), fmt::format("{}: expected a readable folder, found: {}.", folder.string(), error.message())});
  }
}

// A file may be below two of the paths given.
void expect_each_once(std::vector<fs::path>& files) {
  std::sort(files.begin(), files.end());
  std::set<fs::path> known;
  std::erase_if(files, [&](const fs::path& file) {
    std::error_code error;
    const fs::path canonical = fs::weakly_canonical(file, error);
    return !error && !known.insert(canonical).second;
  });
}

}  // namespace

bool is_folder_of_tests(const fs::path& path) {
  std::error_code absent;
  return fs::is_directory(path, absent) ? !fs::exists(path / "session.toml", absent) : is_archive(path);
}

bool any_folder_of_tests(const std::vector<Source>& sources) {
  return std::any_of(sources.begin(), sources.end(),
                     [](const Source& source) { return source.is_path() && is_folder_of_tests(source.path()); });
}

FoundFiles files_below(const std::vector<std::string>& paths) {
  FoundFiles found;
  std::vector<fs::path> folders;
  for (const std::string& path : paths) {
    std::error_code error;
    if (fs::is_directory(path, error)) {
      folders.emplace_back(path);
    } else if (fs::exists(path, error) || bytes_in_archive(path, kLargestText)) {
      add_file(found, path);
    } else {
      throw Error(fmt::format("{}: expected a folder of tests, found nothing of that name.", path));
    }
  }
  add_folders(found, std::move(folders));
  expect_each_once(found.files);
  return found;
}

FoundFiles recordings_below(const std::vector<std::string>& paths) {
  FoundFiles found = files_below(paths);
  std::erase_if(found.files, [&](const fs::path& file) {
    if (std::find(paths.begin(), paths.end(), file.string()) != paths.end() || ends_in(file, ".b5r")) return false;
    const Reader* const reader = Source(file).reader();
    return reader == nullptr || reader->recording.empty();
  });
  return found;
}

FoundFiles put_recordings_below(std::vector<Source>& sources) {
  std::vector<std::string> paths;
  for (const Source& source : sources) {
    if (source.is_path()) paths.push_back(source.name());
  }
  FoundFiles found = recordings_below(paths);
  if (found.files.empty()) return found;
  std::erase_if(sources, [](const Source& source) { return source.is_path(); });
  sources.insert(sources.end(), found.files.begin(), found.files.end());
  return found;
}

}  // namespace ballbar
