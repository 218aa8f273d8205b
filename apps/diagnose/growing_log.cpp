#include "diagnose/growing_log.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <string_view>

#include "ballbar/error.hpp"
#include "ballbar/formats/text/reader.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kPiece = std::size_t{64} << 10;

std::filesystem::path new_folder() {
  std::string name = (std::filesystem::temp_directory_path() / "ballbar-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) {
    throw Error(fmt::format("{}: expected a folder to write to, found: {}.", name, std::strerror(errno)));
  }
  return name;
}

std::string shown_name(const std::string& name) { return name == "-" ? "standard input" : name; }

// What is told by its first bytes, before a row is waited for.
void expect_rows(std::string_view head, const std::string& name) {
  const Reader* const reader = reader_of(head);
  const bool is_text = head.find('\0') == std::string_view::npos;
  if (is_text && (reader == nullptr || reads_series(reader))) return;
  throw Error(fmt::format("{}: expected a log of text that grows by a row a line, found {}.", name, found_in(reader)));
}

}  // namespace

GrowingLog::GrowingLog(const std::string& name) : name_(shown_name(name)) {
  if (name != "-") {
    std::error_code absent;
    if (std::filesystem::is_directory(name, absent)) {
      throw Error(fmt::format("{}: expected a log of text that grows by a row a line, found a directory.", name_));
    }
    descriptor_ = open(name.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor_ < 0) throw Error(fmt::format("{}: cannot be opened: {}.", name_, std::strerror(errno)));
  }
  folder_ = new_folder();
  copy_ = folder_ / "log.csv";
}

GrowingLog::~GrowingLog() {
  std::error_code left;  // nothing that anybody could do
  std::filesystem::remove_all(folder_, left);
  if (descriptor_ > 0) close(descriptor_);
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
  std::ofstream file(copy_, std::ios::binary | std::ios::app);
  file << rest_ << whole;
  file.close();
  if (!file) throw Error(fmt::format("{}: expected room to write, found none.", copy_.string()));
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
  const std::string copy = copy_.string();
  for (std::size_t at = text.find(copy); at != std::string::npos; at = text.find(copy, at + name_.size())) {
    text.replace(at, copy.size(), name_);
  }
  return text;
}

}  // namespace ballbar
