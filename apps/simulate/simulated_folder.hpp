// The folder that a simulation is written to.
#pragma once

#include <filesystem>
#include <set>

namespace ballbar {

// Throws Error where `folder` holds something or `truth_file` exists and not `replace`; with `replace`, where a
// session.toml or a `.b5r` would stay and mix with the files of these names, below the folder.
void expect_room(const std::set<std::filesystem::path>& names, const std::filesystem::path& folder,
                 const std::filesystem::path& truth_file, bool replace);

// With its parents. Throws Error.
void make_folder(const std::filesystem::path& folder);

}  // namespace ballbar
