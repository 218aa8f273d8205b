#include "terminal/state_file.hpp"

#include <fmt/format.h>

#include <cstdint>

#include "ballbar/error.hpp"

namespace ballbar {

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

}  // namespace ballbar
