// A lock file, held by one program at a time. The lock ends with the program, even after a crash. The file goes with
// the lock; one that a crash leaves behind is taken by the next program.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace ballbar {

class FileLock {
 public:
  // Creates the file if needed, and writes into it who holds it. Returns nullopt if another program holds it. Throws
  // Error if it cannot be created or locked.
  static std::optional<FileLock> of(const std::filesystem::path& path, std::string_view holder = {});

  FileLock(FileLock&& other) noexcept : path_(std::move(other.path_)), file_(std::exchange(other.file_, -1)) {}
  FileLock& operator=(FileLock&& other) noexcept {
    std::swap(path_, other.path_);
    std::swap(file_, other.file_);
    return *this;
  }
  ~FileLock();

 private:
  FileLock(std::filesystem::path path, int file) : path_(std::move(path)), file_(file) {}

  std::filesystem::path path_;
  int file_ = -1;
};

}  // namespace ballbar
