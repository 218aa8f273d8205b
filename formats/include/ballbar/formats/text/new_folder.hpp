// Writes folders completely or not at all.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace ballbar {

// Throws Error if `folder` is a file or a folder that is not empty.
void expect_new_folder(const std::filesystem::path& folder);

// Creates a new, uniquely named folder next to `folder`, to be filled and renamed. Throws Error.
std::filesystem::path new_folder_beside(const std::filesystem::path& folder);

// The absolute path without a final slash, so that a sibling can be created. Throws Error for an empty path.
std::filesystem::path folder_to_write(const std::filesystem::path& folder);

// Writes files (name, which may be below a folder, and bytes) to a new or an empty folder, and creates its parents.
// After an Error the folder does not exist, or is empty as before.
void write_folder(const std::filesystem::path& folder, const std::vector<std::pair<std::string, std::string>>& files);

}  // namespace ballbar
