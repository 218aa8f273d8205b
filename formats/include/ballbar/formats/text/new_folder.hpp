// Folders that are written whole or not at all.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace ballbar {

// Throws Error where `folder` is a file or a folder that holds anything.
void expect_new_folder(const std::filesystem::path& folder);

// A new folder beside `folder` that nobody else has, to be filled and renamed. Throws Error.
std::filesystem::path new_folder_beside(const std::filesystem::path& folder);

// Without the slash that may end it, and absolute, so that another can stand beside it. Throws Error where it is empty.
std::filesystem::path folder_to_write(const std::filesystem::path& folder);

// Writes files, name and bytes, to a new or an empty folder; its parents are made too. Throws Error; then there is no
// such folder, or it is as empty as it was.
void write_folder(const std::filesystem::path& folder, const std::vector<std::pair<std::string, std::string>>& files);

}  // namespace ballbar
