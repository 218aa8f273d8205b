// Opens a recording whatever its format: picked by content, never by the file's name.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "ballbar/circle/recording.hpp"
#include "ballbar/formats/recordings/b5r.hpp"
#include "ballbar/formats/text/reader.hpp"
#include "ballbar/formats/text/source.hpp"

namespace ballbar {

struct RecordingFile {
  std::vector<Recording>
      recordings;  // two for most `.b5r`, one for a log, one a run of a table; none where a `.b5r` has results alone
  std::optional<B5r> b5r;              // stored results and equipment, where the file is a `.b5r`; its
                                       // runs and remarks are moved out
  std::vector<std::string> remarks{};  // whole sentences with name:line:column
};

// What a person states of a circle whose file lacks it (circle_table.hpp); other files state their own.
struct StatedCircle {
  std::optional<double> radius_mm;  // nominal, above 0; goes before what the file says
};

// A file whose content is that of a recording, a .b5r, an archive of one, a log or a table, though it may have faults.
bool is_recording_file(const Source& source, std::span<const Reader> readers = known_readers());

// A path through an archive, or an archive of one `.b5r` file, is a `.b5r` (archive.hpp). Throws Error; lists the known
// formats if none fits.
RecordingFile open_recording(const Source& source, std::span<const Reader> readers = known_readers(),
                             const StatedCircle& stated = {});

// Of a recording: whether two linear axes drive it. Its head alone is read; a fault there is told where it is read
// whole.
bool is_of_linear_axes(const Source& file);

// Throws Error where the file has no recording: for what needs readings.
void expect_readings(const RecordingFile& file, const std::filesystem::path& path);

}  // namespace ballbar
