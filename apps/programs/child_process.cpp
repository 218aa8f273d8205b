#include "programs/child_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <memory>
#include <system_error>

#include "ballbar/error.hpp"

namespace ballbar {
namespace {

std::string reason(int number) { return std::generic_category().message(number); }

// Temporary files without a name instead of pipes: no side waits for the other, whatever the sizes, and there is no
// SIGPIPE to keep off.
using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

File temporary_file(const std::string& option) {
  File file(std::tmpfile(), &std::fclose);
  if (!file) throw Error(fmt::format("{}: expected room for a temporary file, found: {}.", option, reason(errno)));
  return file;
}

std::string whole(std::FILE* file) {
  std::string bytes;
  char part[1 << 16];
  std::rewind(file);
  while (const std::size_t count = std::fread(part, 1, sizeof part, file)) bytes.append(part, count);
  return bytes;
}

std::vector<char*> environment(std::string_view without) {
  std::vector<char*> kept;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    if (without.empty() || !std::string_view(*entry).starts_with(without)) kept.push_back(*entry);
  }
  kept.push_back(nullptr);
  return kept;
}

std::vector<char*> as_pointers(std::vector<std::string>& arguments) {
  std::vector<char*> pointers;
  pointers.reserve(arguments.size() + 1);
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  return pointers;
}

class Actions {
 public:
  Actions() {
    if (const int failed = posix_spawn_file_actions_init(&actions_)) throw Error(reason(failed) + ".");
  }
  ~Actions() { posix_spawn_file_actions_destroy(&actions_); }
  Actions(const Actions&) = delete;
  Actions& operator=(const Actions&) = delete;
  posix_spawn_file_actions_t* get() { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_{};
};

bool is_absent(int failed) { return failed == ENOENT || failed == ENOTDIR || failed == EACCES; }

}  // namespace

ChildProcess child_process(const std::string& option, const std::vector<std::string>& arguments, std::string_view in,
                           std::string_view without) {
  const File input = temporary_file(option), out = temporary_file(option), err = temporary_file(option);
  const bool written = std::fwrite(in.data(), 1, in.size(), input.get()) == in.size();
  if (!written || std::fflush(input.get()) != 0) {
    throw Error(fmt::format("{}: expected room for a temporary file, found: {}.", option, reason(errno)));
  }
  std::rewind(input.get());
  Actions actions;
  posix_spawn_file_actions_adddup2(actions.get(), fileno(input.get()), STDIN_FILENO);
  posix_spawn_file_actions_adddup2(actions.get(), fileno(out.get()), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(actions.get(), fileno(err.get()), STDERR_FILENO);
  std::vector<std::string> copy = arguments;
  pid_t child = 0;
  const int failed = posix_spawnp(&child, arguments.front().c_str(), actions.get(), nullptr, as_pointers(copy).data(),
                                  environment(without).data());
  ChildProcess result;
  result.not_found = is_absent(failed);
  if (result.not_found) return result;
  if (failed != 0) {
    throw Error(fmt::format("{}: expected {} to start, found: {}.", option, arguments.front(), reason(failed)));
  }
  // A caller that ignores SIGCHLD leaves no status (ECHILD); the end of the output then tells.
  int status = 0;
  while (waitpid(child, &status, 0) == -1 && errno == EINTR) {
  }
  result.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  result.status = WIFEXITED(status) ? WEXITSTATUS(status) : 0;
  result.out = whole(out.get());
  result.err = whole(err.get());
  return result;
}

bool started(const std::vector<std::string>& arguments) {
  Actions actions;  // what it prints is not ours
  for (const int file : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    posix_spawn_file_actions_addopen(actions.get(), file, "/dev/null", O_RDWR, 0);
  }
  std::vector<std::string> copy = arguments;
  pid_t child = 0;
  return posix_spawnp(&child, arguments.front().c_str(), actions.get(), nullptr, as_pointers(copy).data(), environ) ==
         0;
}

}  // namespace ballbar
