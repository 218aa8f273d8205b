// Paths named in a file must be below its own folder, so that a foreign file cannot open anything else.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace ballbar {

// Checks only the text: not empty, not absolute, not the folder itself, not out of it by "..", no NUL.
bool stays_inside(const std::string& path);

// folder / file. Throws Error where that lies outside the folder, through a link too. `owner`, which named the file,
// stands in the message: "the session". What does not exist yet is no error.
std::filesystem::path path_inside(const std::filesystem::path& folder, const std::string& file, std::string_view owner);

}  // namespace ballbar
