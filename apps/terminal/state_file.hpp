// Files that commands read and write, one program at a time: states of live commands, models.
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

// A lock on a file that a command reads, changes and writes, such as a model: a hidden file beside it. Waits up to 10 s
// for a program that holds it. Returns nullopt where no lock is possible; writing the file then works or reports why
// not. Throws Error if the other program still holds it. `command`: "ballbar add", told to those who wait.
std::optional<FileLock> only_writer(const std::filesystem::path& file, std::string_view command);

}  // namespace ballbar
