#include "terminal/progress.hpp"

#include <unistd.h>

#include <cstdio>
#include <string>

#include "terminal/caller.hpp"

namespace ballbar {

bool progress_is_taken() { return caller() != nullptr && caller()->progress; }

void show_progress(std::string_view line) {
  if (progress_is_taken()) return caller()->progress(line);
  if (isatty(STDERR_FILENO) == 0) return;
  const std::string text = "\r\033[K" + std::string(line);
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

}  // namespace ballbar
