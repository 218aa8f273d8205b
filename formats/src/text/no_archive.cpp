#include "ballbar/formats/text/archive.hpp"

namespace ballbar {

bool is_archive(const std::filesystem::path& /*path*/) { return false; }

std::vector<std::filesystem::path> files_in_archive(const std::filesystem::path& /*path*/) { return {}; }

std::optional<std::string> bytes_in_archive(const std::filesystem::path& /*path*/, std::size_t /*limit*/) {
  return std::nullopt;
}

std::filesystem::path file_on_disk(const std::filesystem::path& path) { return path; }

}  // namespace ballbar
