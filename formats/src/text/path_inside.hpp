// Paths that a file may name: only below its own folder, so that a file from elsewhere opens nothing else.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace ballbar {

// Of the letters alone: not empty, not absolute, not the folder itself, no way out by "..", no NUL.
bool stays_inside(const std::string& path);

// folder / file. Throws Error where that lies outside the folder, through a link too. `owner`, which named the file,
// stands in the message: "the session". What does not exist yet is no error.
std::filesystem::path path_inside(const std::filesystem::path& folder, const std::string& file, std::string_view owner);

}  // namespace ballbar
