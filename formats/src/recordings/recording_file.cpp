#include "ballbar/formats/recordings/recording_file.hpp"

#include <fmt/format.h>

#include <vector>

#include "ballbar/error.hpp"
#include "ballbar/formats/text/archive.hpp"
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

// The only file of an archive stands for it.
std::filesystem::path file_of(const std::filesystem::path& path) {
  if (!is_archive(path)) return path;
  const std::vector<std::filesystem::path> inside = files_in_archive(path);
  if (inside.size() == 1) return inside.front();
  throw Error(fmt::format("{}: expected an archive of one .b5r file, found {}; {} is one of them.", path.string(),
                          inside.size(), inside.front().string()));
}

}  // namespace

bool is_recording_file(const std::filesystem::path& path, std::span<const Reader> readers) {
  if (given_recordings(path) != nullptr) return true;
  if (is_archive(path)) return files_in_archive(path).size() == 1;
  const Reader* const reader = reader_of_file(path, readers);
  return reader != nullptr &&
         (std::holds_alternative<ReadRecordings>(reader->read) || read_of<ReadCircle>(reader) != nullptr);
}

RecordingFile open_recording(const std::filesystem::path& path, std::span<const Reader> readers,
                             const StatedCircle& stated) {
  if (const std::vector<Recording>* const given = given_recordings(path)) return {*given, std::nullopt};
  const std::filesystem::path file = file_of(path);
  const std::optional<std::string> inside = bytes_in_archive(file, kLargestText);
  const std::string bytes = inside ? *inside : read_bytes(file, kLargestTable);
  const std::string name = file.string();
  const Reader* const reader = reader_of(bytes, readers);
  if (const auto read = read_of<ReadRecordings>(reader)) return read(bytes, name);
  if (const auto read = read_of<ReadCircle>(reader)) return read(bytes, name, stated);
  throw Error(fmt::format("{}:1:1: expected a recording, which is {}, found {}.", name, known_recordings(readers),
                          found_in(reader)));
}

void expect_readings(const RecordingFile& file, const std::filesystem::path& path) {
  if (!file.recordings.empty()) return;
  throw Error(fmt::format("{}: expected readings, found {}.", path.string(),
                          file.b5r ? "stored results alone; ballbar fit prints those" : "none"));
}

}  // namespace ballbar
