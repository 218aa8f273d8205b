#include "history/dask_process.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string_view>
#include <system_error>

#include "ballbar/error.hpp"

namespace ballbar {
namespace {

namespace fs = std::filesystem;

constexpr const char* kStart = R"(import sys
try:
    from ballbar.__main__ import history
except ImportError as error:
    sys.exit("ballbar: history: expected the package ballbar of Python with numpy and pandas, found: %s; on Debian install "
             "python3-ballbar and python3-distributed" % error)
except KeyboardInterrupt:
    sys.exit(130)
sys.exit(history(sys.argv[1:])))";

bool is_environment_on() { return std::getenv("VIRTUAL_ENV") != nullptr || std::getenv("CONDA_PREFIX") != nullptr; }

// The package of this program: in a tree that is built, or below the same prefix. Below /usr/lib Python finds it by
// itself, and an environment that is on has its own: first on the path, the modules next to it would hide those of the
// environment.
void add_own_package() {
  std::error_code error;
  const fs::path folder = fs::read_symlink("/proc/self/exe", error).parent_path();
  if (error) return;
  for (const char* place : {"../python", "../lib/python3/dist-packages"}) {
    const fs::path found = (folder / place).lexically_normal();
    const bool is_installed = place != std::string_view("../python");
    if (is_installed && (is_environment_on() || found.string().starts_with("/usr/lib/"))) continue;
    if (!fs::is_directory(found / "ballbar", error)) continue;
    const char* const before = std::getenv("PYTHONPATH");
    const std::string after = before == nullptr ? "" : fmt::format(":{}", before);
    setenv("PYTHONPATH", (found.string() + after).c_str(), 1);
    return;
  }
}

// That of an environment that is on; else the system's, for which Debian's packages are.
std::string python() {
  return !is_environment_on() && access("/usr/bin/python3", X_OK) == 0 ? "/usr/bin/python3" : "python3";
}

}  // namespace

void run_in_python(const std::vector<std::string>& words) {
  add_own_package();
  std::vector<std::string> line{python(), "-P", "-c", kStart};  // -P: a numpy.py of this folder is not run
  line.insert(line.end(), words.begin(), words.end());
  std::vector<char*> arguments;
  arguments.reserve(line.size() + 1);
  for (std::string& word : line) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  std::fflush(nullptr);
  execvp(arguments.front(), arguments.data());
  throw Error(fmt::format("history: expected the program {} to run the package ballbar of Python, found: {}.",
                          line.front(), std::strerror(errno)));
}

}  // namespace ballbar
