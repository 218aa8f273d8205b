// A lock file, held by one program at a time. The lock ends with the program, even after a crash; the empty file stays.
#pragma once

#include <filesystem>
#include <optional>
#include <utility>

namespace ballbar {

class FileLock {
 public:
  // Creates the file if needed. Returns nullopt if another program holds it. Throws Error if it cannot be created or
  // locked.
  static std::optional<FileLock> of(const std::filesystem::path& path);

  FileLock(FileLock&& other) noexcept : file_(std::exchange(other.file_, -1)) {}
  FileLock& operator=(FileLock&& other) noexcept {
    std::swap(file_, other.file_);
    return *this;
  }
  ~FileLock();

 private:
  explicit FileLock(int file) : file_(file) {}

  int file_ = -1;
};

}  // namespace ballbar
