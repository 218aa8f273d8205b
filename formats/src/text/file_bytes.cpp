#include "ballbar/formats/text/file_bytes.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <fstream>
#include <random>
#include <system_error>

#include "ballbar/error.hpp"

namespace ballbar {
namespace {

namespace fs = std::filesystem;

std::string reason(int error) { return std::generic_category().message(error); }

// A name beside `path` that nobody else has: the file is created by this call.
fs::path temporary_beside(const fs::path& path) {
  std::random_device random;
  for (int attempt = 0;; ++attempt) {
    fs::path temporary = path;
    temporary.replace_filename(fmt::format(".{}.{:08x}", path.filename().string(), random()));
    if (std::FILE* file = std::fopen(temporary.c_str(), "wbx")) {
      std::fclose(file);
      return temporary;
    }
    if (errno != EEXIST || attempt == 100) {
      throw Error(fmt::format("{}: expected a folder to write to, found: {}.", path.string(), reason(errno)));
    }
  }
}

int opened(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found) {
    throw Error(fmt::format("{}: expected a file, found nothing of that name.", path.string()));
  }
  if (status.type() == fs::file_type::directory) {
    throw Error(fmt::format("{}: expected a file, found a directory.", path.string()));
  }
  if (status.type() == fs::file_type::none) {
    throw Error(fmt::format("{}: expected a readable file, found: {}.", path.string(), error.message()));
  }
  // A pipe or a device may have no end.
  if (status.type() != fs::file_type::regular) {
    throw Error(fmt::format("{}: expected a regular file, found a pipe, device or socket.", path.string()));
  }
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0)
    throw Error(fmt::format("{}: expected a readable file, found: {}.", path.string(), reason(errno)));
  return descriptor;
}

void write_new(const fs::path& temporary, std::string_view bytes, const fs::path& path) {
  std::ofstream file(temporary, std::ios::binary | std::ios::trunc);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file)
    throw Error(
        fmt::format("{}: expected space to write {} bytes, found: {}.", path.string(), bytes.size(), reason(errno)));
}

// A file or a folder, for the sake of `path`.
void flush_to_disk(const fs::path& written, const fs::path& path) {
  const int file = ::open(written.c_str(), O_RDONLY | O_CLOEXEC);
  const bool flushed = file >= 0 && (::fsync(file) == 0 || errno == EINVAL);  // EINVAL: nothing there that could be
  const int error = errno;
  if (file >= 0) ::close(file);
  if (!flushed)
    throw Error(fmt::format("{}: expected a disk that stores it, found: {}.", path.string(), reason(error)));
}

// Which file was replaced: of a link its target.
fs::path replace(const fs::path& path, const std::function<void(const fs::path&)>& write) {
  std::error_code error;
  const fs::file_type type = fs::status(path, error).type();
  if (path.filename().empty() || type == fs::file_type::directory) {
    throw Error(fmt::format("{}: expected the name of a file to write, found a directory.", path.string()));
  }
  // Renaming onto a device would replace the device.
  if (type != fs::file_type::regular && type != fs::file_type::not_found) {
    throw Error(fmt::format("{}: expected a regular file or a new name, found neither.", path.string()));
  }
  // A link stays a link; its target is replaced.
  const fs::path target = type == fs::file_type::regular ? fs::canonical(path, error) : path;
  if (error && type == fs::file_type::regular) {
    throw Error(fmt::format("{}: expected a file that can be replaced, found: {}.", path.string(), error.message()));
  }
  const fs::path temporary = temporary_beside(target);
  try {
    write(temporary);
    fs::rename(temporary, target);
    return target;
  } catch (const fs::filesystem_error& failed) {
    fs::remove(temporary, error);
    throw Error(
        fmt::format("{}: expected a file that can be replaced, found: {}.", path.string(), failed.code().message()));
  } catch (...) {
    fs::remove(temporary, error);
    throw;
  }
}

}  // namespace

std::string ending_of(const fs::path& path) {
  std::string ending = path.extension().string();
  for (char& c : ending) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return ending;
}

bool ends_in(const fs::path& path, std::string_view ending) { return ending_of(path) == ending; }

OpenFile::OpenFile(const fs::path& path) : path_(path), descriptor_(opened(path)) {}

OpenFile::~OpenFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

std::size_t OpenFile::read(std::size_t offset, char* to, std::size_t most) const {
  std::size_t count = 0;
  while (count < most) {
    const ::ssize_t more = ::pread(descriptor_, to + count, most - count, static_cast<::off_t>(offset + count));
    if (more == 0) break;
    if (more > 0) {
      count += static_cast<std::size_t>(more);
    } else if (errno != EINTR) {
      throw Error(fmt::format("{}: expected a readable file, found an error while reading.", path_.string()));
    }
  }
  return count;
}

std::string OpenFile::head(std::size_t most) const {
  std::string bytes(most, '\0');
  bytes.resize(read(0, bytes.data(), most));
  return bytes;
}

std::size_t OpenFile::size() const {
  struct ::stat status {};
  return ::fstat(descriptor_, &status) == 0 ? static_cast<std::size_t>(status.st_size) : 0;
}

std::string OpenFile::bytes(std::size_t limit) const {
  const auto fail_size = [&] {
    throw Error(fmt::format("{}: expected at most {} MiB, found a larger file.", path_.string(), limit >> 20));
  };
  std::size_t room = size();
  if (room > limit) fail_size();
  // The size may be wrong (a file that grows, or one the system makes up): read to the end whatever it says.
  std::string bytes;
  for (std::size_t used = 0;;) {
    bytes.resize(used + room + 1);
    used += read(used, bytes.data() + used, room + 1);
    if (used > limit) fail_size();
    if (used < bytes.size()) {
      bytes.resize(used);
      return bytes;
    }
    room = std::size_t{1} << 16;
  }
}

std::string read_head(const fs::path& path, std::size_t most) { return OpenFile(path).head(most); }

std::string read_bytes(const fs::path& path, std::size_t limit) { return OpenFile(path).bytes(limit); }

void write_bytes(const fs::path& path, std::string_view bytes) {
  write_through(path, [&](const fs::path& temporary) { write_new(temporary, bytes, path); });
}

void write_bytes_durably(const fs::path& path, std::string_view bytes) {
  const fs::path target = replace(path, [&](const fs::path& temporary) {
    write_new(temporary, bytes, path);
    flush_to_disk(temporary, path);
  });
  flush_to_disk(target.has_parent_path() ? target.parent_path() : ".", path);  // the name
}

void write_through(const fs::path& path, const std::function<void(const fs::path&)>& write) { replace(path, write); }

}  // namespace ballbar
