#include "ballbar/formats/recordings/recording_file.hpp"

#include <fmt/format.h>

#include <vector>

#include "ballbar/error.hpp"
#include "ballbar/formats/recordings/ballbar_log.hpp"
#include "ballbar/formats/text/archive.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "logs/log_sources.hpp"
#include "text/readers.hpp"

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
Source file_of(const Source& source) {
  if (!source.is_archive()) return source;
  const std::vector<std::filesystem::path> inside = files_in_archive(source.path());
  source.close();
  if (inside.size() == 1) return inside.front();
  throw Error(fmt::format("{}: expected an archive of one .b5r file, found {}; {} is one of them.", source.name(),
                          inside.size(), inside.front().string()));
}

}  // namespace

bool is_recording_file(const Source& source, std::span<const Reader> readers) {
  if (source.recordings() != nullptr) return true;
  if (source.is_archive()) return files_in_archive(source.path()).size() == 1;
  const Reader* const reader = source.reader(readers);
  return reader != nullptr &&
         (std::holds_alternative<ReadRecordings>(reader->read) || read_of<ReadCircle>(reader) != nullptr);
}

RecordingFile open_recording(const Source& source, std::span<const Reader> readers, const StatedCircle& stated) {
  if (const std::vector<Recording>* const held = source.recordings()) return {*held, std::nullopt};
  const Source file = file_of(source);
  const std::string bytes = file.bytes(kLargestTable);
  const Reader* const reader = reader_of(bytes, readers);
  if (const auto read = read_of<ReadRecordings>(reader)) return read(bytes, file.name());
  const bool is_large_workbook = reader != nullptr && reader->found == readers::kLog.found && is_table_file(bytes);
  if (const auto read = read_of<ReadCircle>(is_large_workbook ? &readers::kCircleTable : reader)) {
    StatedCircle how = stated;
    how.table = source.recipe();
    return read(bytes, file.name(), how);
  }
  throw Error(fmt::format("{}:1:1: expected a recording, which is {}, found {}.", file.name(),
                          known_recordings(readers), found_in(reader)));
}

bool is_of_linear_axes(const Source& file) {
  // Only a ballbar log can be of another motion, or of a bar along the axis.
  const Reader* const reader = file.reader();
  if (reader == nullptr || reader->found != readers::kBallbarLog.found) return true;
  const std::string head = file.head(kHeadBytes);
  try {
    const Recording header = read_ballbar_log_header(std::string_view(head).substr(0, head.rfind('\n')), file.name());
    return header.kind == Kind::circle && header.motion == Motion::linear_axes;
  } catch (const Error&) {
    return true;
  }
}

void expect_readings(const RecordingFile& file, const std::filesystem::path& path) {
  if (!file.recordings.empty()) return;
  throw Error(fmt::format("{}: expected readings, found {}.", path.string(),
                          file.b5r ? "only stored results. Show them with ballbar fit" : "none"));
}

}  // namespace ballbar
