#include "pictures/heard_stderr.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>
#include <mutex>

namespace ballbar {
namespace {

constexpr int kStandardError = 2;
constexpr std::size_t kMost = 200;

// The standard error goes to `file` for as long as this lives.
class Diverted {
 public:
  explicit Diverted(std::FILE* file) : kept_(dup(kStandardError)) {
    std::fflush(stderr);
    if (kept_ >= 0) dup2(fileno(file), kStandardError);
  }
  ~Diverted() {
    std::fflush(stderr);
    if (kept_ < 0) return;
    dup2(kept_, kStandardError);
    close(kept_);
  }
  Diverted(const Diverted&) = delete;
  Diverted& operator=(const Diverted&) = delete;

 private:
  int kept_;
};

std::string first_line(std::FILE* file) {
  std::array<char, kMost> start{};
  std::rewind(file);
  std::string line(start.data(), std::fread(start.data(), 1, start.size(), file));
  line.resize(std::min(line.find('\n'), line.size()));
  constexpr const char* kPng = "libpng error: ";
  if (line.starts_with(kPng)) line.erase(0, std::char_traits<char>::length(kPng));
  std::replace_if(
      line.begin(), line.end(), [](char c) { return c < 0x20 || c == 0x7F; }, '?');
  while (line.ends_with('.')) line.pop_back();
  return line;
}

}  // namespace

std::string heard_stderr(const std::function<void()>& work) {
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::tmpfile(), &std::fclose);
  if (!file) {
    work();
    return {};
  }
  {
    const Diverted diverted(file.get());
    work();
  }
  return first_line(file.get());
}

}  // namespace ballbar
