// The known file formats. Each entry of the list recognises its format by the first bytes, never by the file name.
//
// A format is one source file with its entry, its test, and a line in formats/src/readers.cpp. The functions that open
// files (open_recording, open_series, open_session, open_drift_data, open_model_data) take the list as an argument; the
// default is the list of all formats.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <variant>

namespace ballbar {

class Source;
struct Log;
struct RecordingFile;
struct Series;
struct SessionPlan;
struct StatedCircle;

inline constexpr std::size_t kHeadBytes = std::size_t{1} << 16;  // enough for any header

// Functions that read the bytes of a whole file. `name` is used in messages; they throw Error with name:line:column. A
// null function means that the format is recognised, for messages, but cannot be read.
using ReadRecordings = RecordingFile (*)(std::string_view bytes, std::string_view name);
using ReadCircle = RecordingFile (*)(std::string_view bytes, std::string_view name, const StatedCircle& stated);
using ReadSeries = Series (*)(std::string_view bytes, std::string_view name);
using ReadLog = Log (*)(const Source& source);  // the file is not held in memory
using ReadSession = SessionPlan (*)(std::string_view bytes, std::string_view name);

struct Reader {
  std::string_view found;      // for people, after "found": "a ballbar log"
  std::string_view recording;  // after "expected a recording, which is"; empty: not listed there
  bool (*is_yours)(std::string_view head) =
      nullptr;  // of the first kHeadBytes of a file, or of all where it is shorter
  // monostate: for another opener
  std::variant<std::monostate, ReadRecordings, ReadCircle, ReadSeries, ReadLog, ReadSession> read;
};

// All formats, in the order in which they are tried.
std::span<const Reader> known_readers();

// The first reader that recognises the head; nullptr: unknown format.
const Reader* reader_of(std::string_view head, std::span<const Reader> readers = known_readers());

// For "found ...": the words of the reader, or "text of no known format" without one.
std::string_view found_in(const Reader* reader);

// The function of the reader with this return type; null without a reader or such a function.
template <class Read>
Read read_of(const Reader* reader) {
  const Read* const read = reader == nullptr ? nullptr : std::get_if<Read>(&reader->read);
  return read == nullptr ? nullptr : *read;
}

// Whether the reader is for recordings. False for a format that is only recognised by what it lacks.
inline bool reads_recordings(const Reader* reader) {
  return read_of<ReadRecordings>(reader) != nullptr || read_of<ReadCircle>(reader) != nullptr;
}

// Whether the reader is for a series, or for a log that is read as one.
inline bool reads_series(const Reader* reader) {
  return read_of<ReadSeries>(reader) != nullptr || read_of<ReadLog>(reader) != nullptr;
}

}  // namespace ballbar
