// The recordings in folders and archives, and what of them could not be read.
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
  std::vector<std::filesystem::path> files;  // by their names, each once
  std::vector<SkippedFile> faults;           // folders that cannot be listed, archives that are damaged
};

// A folder without a session.toml, or an archive.
bool is_folder_of_tests(const std::filesystem::path& path);
bool any_folder_of_tests(const std::vector<Source>& sources);

// Files as they are given, and all regular ones in the folders given and those below: hidden ones and links to folders
// are passed over, and in place of an archive stand the `.b5r` files inside it. Throws Error for a path that is not
// there.
FoundFiles files_below(const std::vector<std::string>& paths);

// Of those the recordings, by content or by the ending .b5r; a file that is given stays whatever it is.
FoundFiles recordings_below(const std::vector<std::string>& paths);

// The recordings below the folders in place of these; what a program holds stays. Nothing found: as it was.
FoundFiles put_recordings_below(std::vector<Source>& sources);

}  // namespace ballbar
