// Reads and writes whole files. Sizes are bounded, and a file is written completely or not at all.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace ballbar {

inline constexpr std::size_t kLargestTable = std::size_t{1} << 30;  // a .csv: 1 GiB
inline constexpr std::size_t kLargestText = std::size_t{16} << 20;  // .b5r and .toml: 16 MiB

std::string ending_of(const std::filesystem::path& path);  // ".b5r" of "A.B5R", in small letters

// "A.B5R" ends in ".b5r": an ending in small letters, whatever letters the name has.
bool ends_in(const std::filesystem::path& path, std::string_view ending);

// A regular file, open for reading. Throws Error as read_bytes.
class OpenFile {
 public:
  explicit OpenFile(const std::filesystem::path& path);
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  ~OpenFile();

  std::size_t read(std::size_t offset, char* to, std::size_t most) const;  // fewer bytes than `most`: the end
  [[nodiscard]] std::string head(std::size_t most) const;
  [[nodiscard]] std::string bytes(std::size_t limit) const;
  [[nodiscard]] std::size_t size() const;  // as the system states it

 private:
  std::filesystem::path path_;
  int descriptor_;
};

// The bytes of a regular file. Throws Error: missing, a directory or other special file, unreadable,
// larger than `limit`.
std::string read_bytes(const std::filesystem::path& path, std::size_t limit);

// The first `most` bytes of a regular file of any size; all where it is shorter. Throws Error as read_bytes.
std::string read_head(const std::filesystem::path& path, std::size_t most);

// Writes to a temporary file beside `path` and renames it. Throws Error; then `path` is as it was.
void write_bytes(const std::filesystem::path& path, std::string_view bytes);

// The same for a state that must survive a power failure: it is on disk when this returns. Takes milliseconds.
// After an Error `path` is unchanged, or written but perhaps not yet on disk.
void write_bytes_durably(const std::filesystem::path& path, std::string_view bytes);

// As write_bytes() for a library that writes files itself: `write` is called with the name of an empty temporary file.
void write_through(const std::filesystem::path& path,
                   const std::function<void(const std::filesystem::path& temporary)>& write);

}  // namespace ballbar
