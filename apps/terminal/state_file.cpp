#include "terminal/state_file.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cstdint>
#include <thread>

#include "ballbar/error.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "terminal/stderr_line.hpp"

namespace ballbar {
namespace {

constexpr std::chrono::milliseconds kLongestWait{10000}, kBetweenTries{20}, kQuietWait{500};
constexpr std::size_t kHolderBytes = 200;

// Who holds a lock, as the file says; the holder may just have let it go.
std::string holder_of(const std::filesystem::path& lock) {
  try {
    const std::string holder = read_head(lock, kHolderBytes);
    if (!holder.empty()) return holder;
  } catch (const Error&) {  // it has gone
  }
  return "another program";
}

}  // namespace

// FNV-1a, 64 bits.
std::string digest_of(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  return fmt::format("{:016x}, {} bytes", hash, text.size());
}

std::optional<FileLock> only_program(const std::filesystem::path& state) {
  namespace fs = std::filesystem;
  std::error_code error;
  const bool is_there = fs::is_regular_file(state, error);
  const fs::path folder = state.has_parent_path() ? state.parent_path() : ".";
  if (!is_there && (fs::exists(state, error) || !fs::is_directory(folder, error))) return {};
  fs::path lock = is_there ? fs::canonical(state) : state;
  lock += ".lock";
  std::optional<FileLock> held = FileLock::of(lock);
  if (held) return held;
  throw Error(fmt::format(
      "{}: expected no other program that uses this state, found one. End that program, or give this one its own file.",
      state.string()));
}

std::optional<FileLock> only_writer(const std::filesystem::path& file, std::string_view command) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::path there = fs::weakly_canonical(file, error);  // a link and its target are one file
  if (error || there.filename().empty() || fs::is_directory(there, error)) return std::nullopt;
  const fs::path lock = there.parent_path() / fmt::format(".{}.lock", there.filename().string());
  const auto begin = std::chrono::steady_clock::now();
  for (bool is_told = false;;) {
    try {
      auto held = FileLock::of(lock, fmt::format("{} (process {})", command, ::getpid()));
      if (held) return held;
    } catch (const Error&) {
      return std::nullopt;
    }
    const auto waited = std::chrono::steady_clock::now() - begin;
    if (waited > kLongestWait) {
      throw Error(
          fmt::format("{}: expected no other program that changes this file, found {}, for which 10 s were waited. Try "
                      "again when it "
                      "has ended.",
                      file.string(), holder_of(lock)));
    }
    if (!is_told && waited > kQuietWait) {
      stderr_line(
          fmt::format("{}: waiting up to 10 s for {}, which changes this file", file.string(), holder_of(lock)));
      is_told = true;
    }
    std::this_thread::sleep_for(kBetweenTries);
  }
}

}  // namespace ballbar
