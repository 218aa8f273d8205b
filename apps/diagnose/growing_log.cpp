#include "diagnose/growing_log.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <string_view>

#include "ballbar/error.hpp"
#include "ballbar/formats/text/reader.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kPiece = std::size_t{64} << 10;

std::string shown_name(const std::string& name) { return name == "-" ? "standard input" : name; }

// What is told by its first bytes, before a row is waited for.
void expect_rows(std::string_view head, const std::string& name) {
  const Reader* const reader = reader_of(head);
  const bool is_text = head.find('\0') == std::string_view::npos;
  if (is_text && (reader == nullptr || reads_series(reader))) return;
  throw Error(fmt::format("{}: expected a text log with one row per line, found {}.", name, found_in(reader)));
}

}  // namespace

GrowingLog::GrowingLog(const std::string& name) : name_(shown_name(name)) {
  if (name != "-") {
    std::error_code absent;
    if (std::filesystem::is_directory(name, absent)) {
      throw Error(fmt::format("{}: expected a text log with one row per line, found a directory.", name_));
    }
    descriptor_ = open(name.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor_ < 0) throw Error(fmt::format("{}: cannot be opened: {}.", name_, std::strerror(errno)));
  }
  copy_descriptor_ = memfd_create("log", MFD_CLOEXEC);
  if (copy_descriptor_ < 0) throw Error(fmt::format("{}: no memory for it: {}.", name_, std::strerror(errno)));
  copy_ = fmt::format("/proc/self/fd/{}", copy_descriptor_);
}

GrowingLog::~GrowingLog() {
  if (descriptor_ > 0) close(descriptor_);
  if (copy_descriptor_ >= 0) close(copy_descriptor_);
}

bool GrowingLog::take() {
  expect_same_file();
  std::array<char, kPiece> piece{};
  const std::size_t before = taken_;
  while (!has_ended_) {
    struct pollfd ready {
      descriptor_, POLLIN, 0
    };
    if (poll(&ready, 1, 0) <= 0) break;
    const ssize_t count = read(descriptor_, piece.data(), piece.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw Error(fmt::format("{}: {}.", name_, std::strerror(errno)));
    if (count == 0) {
      has_ended_ = descriptor_ == 0;
      break;
    }
    const std::string_view bytes(piece.data(), static_cast<std::size_t>(count));
    if (taken_ == 0) expect_rows(bytes, name_);
    taken_ += bytes.size();
    keep(bytes);
  }
  return taken_ > before;
}

void GrowingLog::keep(std::string_view bytes) {
  const std::size_t last = bytes.rfind('\n');
  if (last == std::string_view::npos) {
    rest_ += bytes;
    return;
  }
  const std::string_view whole = bytes.substr(0, last + 1);
  lines_ += static_cast<std::size_t>(std::count(whole.begin(), whole.end(), '\n'));
  rest_ += whole;
  for (std::size_t written = 0; written < rest_.size();) {
    const ssize_t count = write(copy_descriptor_, rest_.data() + written, rest_.size() - written);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw Error(fmt::format("{}: no memory for it: {}.", name_, std::strerror(errno)));
    written += static_cast<std::size_t>(count);
  }
  rest_ = bytes.substr(last + 1);
}

void GrowingLog::expect_same_file() const {
  struct stat ours {
  }, named{};
  if (descriptor_ == 0 || fstat(descriptor_, &ours) != 0 || !S_ISREG(ours.st_mode)) return;
  if (ours.st_size < lseek(descriptor_, 0, SEEK_CUR)) {
    throw Error(fmt::format("{}: expected a file that grows, found it shorter than it was.", name_));
  }
  if (stat(name_.c_str(), &named) == 0 && (named.st_ino != ours.st_ino || named.st_dev != ours.st_dev)) {
    throw Error(fmt::format("{}: expected the file that was opened, found another one of that name.", name_));
  }
}

std::string GrowingLog::with_its_name(std::string text) const {
  for (std::size_t at = text.find(copy_); at != std::string::npos; at = text.find(copy_, at + name_.size())) {
    text.replace(at, copy_.size(), name_);
  }
  return text;
}

}  // namespace ballbar
