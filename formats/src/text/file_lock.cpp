#include "ballbar/formats/text/file_lock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "ballbar/error.hpp"

namespace ballbar {
namespace {

// Whether the open file is still the one of that name: its holder may have removed it meanwhile.
bool is_at(const std::filesystem::path& path, int file) {
  struct ::stat held {
  }, there{};
  return ::fstat(file, &held) == 0 && ::stat(path.c_str(), &there) == 0 && held.st_dev == there.st_dev &&
         held.st_ino == there.st_ino;
}

}  // namespace

std::optional<FileLock> FileLock::of(const std::filesystem::path& path, std::string_view holder) {
  const auto fail = [&](int error) {
    throw Error(fmt::format("{}: expected a file that can be locked, found: {}.", path.string(),
                            std::generic_category().message(error)));
  };
  while (true) {
    const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (file < 0) fail(errno);
    int locked = 0;
    do locked = ::flock(file, LOCK_EX | LOCK_NB);
    while (locked != 0 && errno == EINTR);
    const int error = errno;
    if (locked == 0 && is_at(path, file)) {
      // Who holds it is only told to others: a full disk is no reason to fail.
      if (::ftruncate(file, 0) == 0 && ::write(file, holder.data(), holder.size()) < 0) errno = 0;
      return FileLock(path, file);
    }
    ::close(file);
    if (locked == 0) continue;
    if (error != EWOULDBLOCK) fail(error);
    return std::nullopt;
  }
}

FileLock::~FileLock() {
  if (file_ < 0) return;
  ::unlink(path_.c_str());  // while it is locked: who waits for it sees that it is gone, and makes a new one
  ::close(file_);
}

}  // namespace ballbar
