// Reads `.b5r` files inside an archive (.zip). Their paths treat the archive as a folder: "tests.zip/00.b5r". Nothing
// is unpacked to disk. In a build without libzip (BALLBAR_XLSX=OFF) no file counts as an archive.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace ballbar {

// Whether the path is a regular file with the content of a zip and a `.b5r` inside, or a damaged file called .zip.
bool is_archive(const std::filesystem::path& path);

// Paths of the `.b5r` files inside, sorted, without hidden ones. Throws Error: damaged, more than 10 000 entries or 1
// GiB unpacked, a name that is absolute or has "..".
std::vector<std::filesystem::path> files_in_archive(const std::filesystem::path& path);

// The bytes of a path into an archive; nullopt if no part of the path is an archive. Throws Error: no such file inside,
// a password, damage, more than `limit` bytes, whatever size the archive states.
std::optional<std::string> bytes_in_archive(const std::filesystem::path& path, std::size_t limit);

// The archive of a path into one; any other path unchanged.
std::filesystem::path file_on_disk(const std::filesystem::path& path);

}  // namespace ballbar
