// The formats that files are told by: each entry of one list knows its own by the first bytes, never by the file's
// name.
//
// A format is one file of source with its entry, its test, and a line in formats/src/readers.cpp. What opens a file
// (open_recording, open_series, open_session, open_drift_data, open_model_data) takes the list as a value; the list of
// all formats is the default.
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

inline constexpr std::size_t kHeadBytes = std::size_t{1} << 16;  // a header is far shorter

// What a reader makes of the bytes of a whole file. `name` stands in messages; throws Error with name:line:column. A
// null function: known, so that a message can say what was found, but not to be read.
using ReadRecordings = RecordingFile (*)(std::string_view bytes, std::string_view name);
using ReadCircle = RecordingFile (*)(std::string_view bytes, std::string_view name, const StatedCircle& stated);
using ReadSeries = Series (*)(std::string_view bytes, std::string_view name);
using ReadLog = Log (*)(const Source& source);  // not held in memory
using ReadSession = SessionPlan (*)(std::string_view bytes, std::string_view name);

struct Reader {
  std::string_view found;      // for people, after "found": "a ballbar log"
  std::string_view recording;  // after "expected a recording, which is"; empty: not listed there
  bool (*is_yours)(std::string_view head) =
      nullptr;  // of the first kHeadBytes of a file, or of all where it is shorter
  // monostate: for another opener
  std::variant<std::monostate, ReadRecordings, ReadCircle, ReadSeries, ReadLog, ReadSession> read;
};

// All formats, in the order in which they are asked.
std::span<const Reader> known_readers();

// The first that says the head is its own; null for text of no known format.
const Reader* reader_of(std::string_view head, std::span<const Reader> readers = known_readers());

// For "found ...": the reader's own words; without one "text of no known format".
std::string_view found_in(const Reader* reader);

// The function of the reader that returns this; null where there is no reader, or none such.
template <class Read>
Read read_of(const Reader* reader) {
  const Read* const read = reader == nullptr ? nullptr : std::get_if<Read>(&reader->read);
  return read == nullptr ? nullptr : *read;
}

// A recording, though it may have faults; false of a format that is only known by what it lacks.
inline bool reads_recordings(const Reader* reader) {
  return read_of<ReadRecordings>(reader) != nullptr || read_of<ReadCircle>(reader) != nullptr;
}

// A series, or a log that is taken for one.
inline bool reads_series(const Reader* reader) {
  return read_of<ReadSeries>(reader) != nullptr || read_of<ReadLog>(reader) != nullptr;
}

}  // namespace ballbar
