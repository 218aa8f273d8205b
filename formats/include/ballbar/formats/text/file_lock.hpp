// A file that one program holds at a time. It is let go of when the program ends, however that comes about; the file,
// which is empty, stays.
#pragma once

#include <filesystem>
#include <optional>
#include <utility>

namespace ballbar {

class FileLock {
 public:
  // Makes the file where there is none. Nothing: another holds it. Throws Error where it can be neither made nor
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
