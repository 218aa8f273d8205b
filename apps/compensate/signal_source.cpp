#include "compensate/signal_source.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "ballbar/error.hpp"
#include "terminal/stderr_line.hpp"

namespace ballbar {
namespace {

constexpr int kPause_ms = 50;  // between looks at a file that may grow

bool is_file(const struct stat& status) { return S_ISREG(status.st_mode); }

}  // namespace

SignalSource::SignalSource(const std::string& name, bool follow, double silence_s,
                           const volatile std::sig_atomic_t& stop)
    : name_(name), follow_(follow), silence_s_(silence_s), stop_(stop) {
  if (name != "-") open_file();
}

SignalSource::~SignalSource() {
  if (descriptor_ > 0) close(descriptor_);
}

void SignalSource::open_file() {
  const int opened = open(name_.c_str(), O_RDONLY | O_CLOEXEC);
  if (opened < 0) throw Error(fmt::format("{}: cannot be opened: {}.", name_, std::strerror(errno)));
  if (descriptor_ > 0) close(descriptor_);
  descriptor_ = opened;
}

std::string_view SignalSource::read() {
  double waited_s = 0.0;
  while (stop_ == 0) {
    struct pollfd ready {
      descriptor_, POLLIN, 0
    };
    const int found = poll(&ready, 1, kPause_ms);
    if (found < 0 && errno != EINTR) throw Error(fmt::format("{}: {}.", name_, std::strerror(errno)));
    if (found <= 0) {
      if (found == 0) wait(waited_s);
      continue;
    }
    const ssize_t count = ::read(descriptor_, piece_.data(), piece_.size());
    if (count > 0) return {piece_.data(), static_cast<std::size_t>(count)};
    if (count < 0 && errno != EINTR) throw Error(fmt::format("{}: {}.", name_, std::strerror(errno)));
    if (count != 0) continue;
    if (!follow_) return {};
    expect_grows();
    if (replaced()) {
      open_file();
      reopened_ = true;
      return {};
    }
    usleep(kPause_ms * 1000);
    wait(waited_s);
  }
  return {};
}

// Says once when nothing has come for too long.
void SignalSource::wait(double& waited_s) const {
  const double before_s = waited_s;
  waited_s += 1e-3 * kPause_ms;
  if (before_s <= silence_s_ && waited_s > silence_s_) {
    stderr_line(
        fmt::format("{}: no row for {:g} s; the offsets stay", name_ == "-" ? "standard input" : name_, silence_s_));
  }
}

bool SignalSource::reopened() {
  const bool was = reopened_;
  reopened_ = false;
  return was;
}

bool SignalSource::replaced() const {
  struct stat ours {
  }, named{};
  if (fstat(descriptor_, &ours) != 0 || !is_file(ours) || stat(name_.c_str(), &named) != 0) return false;
  return is_file(named) && (named.st_ino != ours.st_ino || named.st_dev != ours.st_dev);
}

// One that begins anew would be read from the middle, or never again.
void SignalSource::expect_grows() const {
  struct stat now {};
  if (fstat(descriptor_, &now) != 0 || !is_file(now)) return;
  if (now.st_size < lseek(descriptor_, 0, SEEK_CUR)) {
    throw Error(fmt::format("{}: expected a file that grows, found it shorter than it was.", name_));
  }
}

std::optional<SignalsPlace> SignalSource::place() const {
  struct stat now {};
  if (descriptor_ == 0 || fstat(descriptor_, &now) != 0 || !is_file(now)) return std::nullopt;
  std::error_code error;
  const std::filesystem::path whole = std::filesystem::weakly_canonical(name_, error);
  return SignalsPlace{error ? name_ : whole.string(), now.st_ino, 0};
}

}  // namespace ballbar
