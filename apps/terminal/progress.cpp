#include "terminal/progress.hpp"

#include <unistd.h>

#include <cstdio>
#include <string>

namespace ballbar {
namespace {

void (*taker_of_lines)(std::string_view) = nullptr;

}  // namespace

void send_progress_to(void (*taker)(std::string_view line)) { taker_of_lines = taker; }

bool progress_is_taken() { return taker_of_lines != nullptr; }

void show_progress(std::string_view line) {
  if (taker_of_lines != nullptr) return taker_of_lines(line);
  if (isatty(STDERR_FILENO) == 0) return;
  const std::string text = "\r\033[K" + std::string(line);
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

}  // namespace ballbar
