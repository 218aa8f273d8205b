// State files of live commands.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "ballbar/formats/text/file_lock.hpp"

namespace ballbar {

// Identifies a model in a state that is written every second; not cryptographic. "cbf29ce484222325, 0 bytes"
std::string digest_of(std::string_view text);

// A lock for the lifetime of the program, so that no other program uses the same state. Returns nullopt if no state
// file can exist there; writing it then reports the error. Throws Error if another program holds the lock.
std::optional<FileLock> only_program(const std::filesystem::path& state);

}  // namespace ballbar
