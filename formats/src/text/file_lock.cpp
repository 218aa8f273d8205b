#include "ballbar/formats/text/file_lock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "ballbar/error.hpp"

namespace ballbar {

std::optional<FileLock> FileLock::of(const std::filesystem::path& path) {
  const auto fail = [&](int error) {
    throw Error(fmt::format("{}: expected a file that can be locked, found: {}.", path.string(),
                            std::generic_category().message(error)));
  };
  const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (file < 0) fail(errno);
  FileLock lock(file);
  int locked = 0;
  do locked = ::flock(file, LOCK_EX | LOCK_NB);
  while (locked != 0 && errno == EINTR);
  if (locked == 0) return lock;
  if (errno != EWOULDBLOCK) fail(errno);
  return std::nullopt;
}

FileLock::~FileLock() {
  if (file_ >= 0) ::close(file_);
}

}  // namespace ballbar
