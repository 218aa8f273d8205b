// Finds the recordings in folders and archives, with a list of those that could not be read.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "ballbar/formats/text/source.hpp"

namespace ballbar {

struct SkippedFile {
  std::string file;
  std::string why;  // a whole sentence that begins with the file's name
};

struct FoundFiles {
  std::vector<std::filesystem::path> files;  // sorted by name, each once
  std::vector<SkippedFile> faults;           // folders that cannot be listed, damaged archives
};

// Whether the path is a folder without a session.toml, or an archive.
bool is_folder_of_tests(const std::filesystem::path& path);
bool any_folder_of_tests(const std::vector<Source>& sources);

// The given files, and all regular files in and below the given folders, without hidden ones and links to folders. An
// archive is replaced by the `.b5r` files inside it. Throws Error for a path that does not exist.
FoundFiles files_below(const std::vector<std::string>& paths);

// The recordings among files_below(), by content or by the extension .b5r. Explicitly given files are always kept.
FoundFiles recordings_below(const std::vector<std::string>& paths);

// Replaces folders by the recordings below them; sources in memory stay. If nothing is found, `sources` is unchanged.
FoundFiles put_recordings_below(std::vector<Source>& sources);

}  // namespace ballbar
