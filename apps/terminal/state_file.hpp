// Files that keep where a live command stands.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "ballbar/formats/text/file_lock.hpp"

namespace ballbar {

// To tell models apart in a state that is written every second; no seal. "cbf29ce484222325, 0 bytes"
std::string digest_of(std::string_view text);

// Held while the program runs, so that no other keeps the same state. Nothing where no state can be: writing it says
// so. Throws Error where another program holds it.
std::optional<FileLock> only_program(const std::filesystem::path& state);

}  // namespace ballbar
