#include "ballbar/formats/recordings/recording_file.hpp"

#include <fmt/format.h>

#include <vector>

#include "ballbar/error.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "ballbar/formats/text/given_data.hpp"

namespace ballbar {
namespace {

// "a, b or c", as the list says.
std::string known_recordings(std::span<const Reader> readers) {
  std::vector<std::string_view> known;
  for (const Reader& reader : readers) {
    if (!reader.recording.empty()) known.push_back(reader.recording);
  }
  std::string text;
  for (std::size_t i = 0; i < known.size(); ++i) {
    if (i > 0) text += i + 1 == known.size() ? " or " : ", ";
    text += known[i];
  }
  return text;
}

}  // namespace

bool is_recording_file(const std::filesystem::path& path, std::span<const Reader> readers) {
  if (given_recordings(path) != nullptr) return true;
  const Reader* const reader = reader_of_file(path, readers);
  return reader != nullptr && std::holds_alternative<ReadRecordings>(reader->read);
}

RecordingFile open_recording(const std::filesystem::path& path, std::span<const Reader> readers) {
  if (const std::vector<Recording>* const given = given_recordings(path)) return {*given, std::nullopt};
  const std::string bytes = read_bytes(path, kLargestTable);
  const std::string name = path.string();
  const Reader* const reader = reader_of(bytes, readers);
  if (const auto read = read_of<ReadRecordings>(reader)) return read(bytes, name);
  throw Error(fmt::format("{}:1:1: expected a recording, which is {}, found {}.", name, known_recordings(readers),
                          found_in(reader)));
}

void expect_readings(const RecordingFile& file, const std::filesystem::path& path) {
  if (!file.recordings.empty()) return;
  throw Error(fmt::format("{}: expected readings, found {}.", path.string(),
                          file.b5r ? "stored results alone; ballbar fit prints those" : "none"));
}

}  // namespace ballbar
