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
#include "report/page_calls.hpp"
#include "terminal/caller.hpp"
#include "terminal/stderr_line.hpp"

namespace {

// clang-format off
EM_JS(void, tell_progress, (const char* text, int length), {
  Module.progress(UTF8ToString(text, length));
});
// clang-format on

}  // namespace

// What the program asks a system for, and a page has not: other programs.
extern "C" int posix_spawnp(pid_t*, const char*, const posix_spawn_file_actions_t*, const posix_spawnattr_t*,
                            char* const*, char* const*) {
  return ENOENT;
}

namespace {

// The work of a page with the streams in files, and progress told. Returns the exit status.
template <class Work>
int with_streams(const char* out, const char* err, Work work) {
  if (std::freopen(out, "w", stdout) == nullptr || std::freopen(err, "w", stderr) == nullptr) return 1;
  std::cout.clear();
  ballbar::Caller page;
  page.progress = [](std::string_view line) { tell_progress(line.data(), static_cast<int>(line.size())); };
  const ballbar::CalledBy called(page);
  const int status = work();
  std::cout.flush();
  std::fflush(stdout);
  std::fflush(stderr);
  return status;
}

}  // namespace

// Runs `ballbar WORDS...`. words: a JSON array of strings. The standard output goes to the file `out`, standard error
// to `err`. Returns the exit status.
extern "C" EMSCRIPTEN_KEEPALIVE int ballbar_run(const char* words, const char* out, const char* err) {
  return with_streams(out, err,
                      [&] { return ballbar::program(nlohmann::json::parse(words).get<std::vector<std::string>>()); });
}

// A call of page_calls.hpp; its answer goes to `out`, why there is none to `err`.
extern "C" EMSCRIPTEN_KEEPALIVE int ballbar_call(const char* call, const char* out, const char* err) {
  static ballbar::PageCalls calls;
  return with_streams(out, err, [&] {
    try {
      ballbar::print_json(calls.answer(nlohmann::json::parse(call)), -1);
      return 0;
    } catch (const std::exception& error) {  // Error; out of memory
      ballbar::error_line(error.what());
      return 1;
    }
  });
}
