// The `.b5r` files inside an archive (.zip), each with a path as if the archive were a folder: "tests.zip/00.b5r".
// Nothing is unpacked to the disk. In a build without libzip (BALLBAR_XLSX=OFF) no file is an archive.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace ballbar {

// A regular file that is a zip by its content and has a `.b5r` inside, or one called .zip that is damaged.
bool is_archive(const std::filesystem::path& path);

// Paths of the `.b5r` files inside, sorted. Throws Error: damaged, more than 10 000 entries or 1 GiB unpacked, a name
// that is absolute or has "..".
std::vector<std::filesystem::path> files_in_archive(const std::filesystem::path& path);

// The bytes of a path through an archive; nothing where no part of the path is one. Throws Error: no such file inside,
// locked by a password, damaged, more than `limit` bytes whatever size the archive claims.
std::optional<std::string> bytes_in_archive(const std::filesystem::path& path, std::size_t limit);

// The archive of a path through one; any other path as it is.
std::filesystem::path file_on_disk(const std::filesystem::path& path);

}  // namespace ballbar
