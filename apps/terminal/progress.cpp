#include "terminal/progress.hpp"

#include <unistd.h>

#include <cstdio>
#include <string>

namespace ballbar {

void show_progress(std::string_view line) {
  if (isatty(STDERR_FILENO) == 0) return;
  const std::string text = "\r\033[K" + std::string(line);
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

}  // namespace ballbar
