// The program in a page: a worker calls it again and again, with files in memory.
#include <emscripten.h>
#include <spawn.h>

#include <cerrno>
#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "program.hpp"
#include "terminal/caller.hpp"

namespace {

// clang-format off
EM_JS(void, tell_progress, (const char* text, int length), {
  Module.progress(UTF8ToString(text, length));
});
// clang-format on

}  // namespace

// What the program asks a system for, and a page has not: other programs, and files without a name.
extern "C" int posix_spawnp(pid_t*, const char*, const posix_spawn_file_actions_t*, const posix_spawnattr_t*,
                            char* const*, char* const*) {
  return ENOENT;
}
extern "C" int memfd_create(const char*, unsigned) {
  errno = ENOSYS;
  return -1;
}

// Runs `ballbar WORDS...`. words: a JSON array of strings. The standard output goes to the file `out`, standard error
// to `err`. Returns the exit status.
extern "C" EMSCRIPTEN_KEEPALIVE int ballbar_run(const char* words, const char* out, const char* err) {
  if (std::freopen(out, "w", stdout) == nullptr || std::freopen(err, "w", stderr) == nullptr) return 1;
  std::cout.clear();
  ballbar::Caller page;
  page.progress = [](std::string_view line) { tell_progress(line.data(), static_cast<int>(line.size())); };
  const ballbar::CalledBy called(page);
  const int status = ballbar::program(nlohmann::json::parse(words).get<std::vector<std::string>>());
  std::cout.flush();
  std::fflush(stdout);
  std::fflush(stderr);
  return status;
}
