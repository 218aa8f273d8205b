// Opens a recording of any format. The format is recognised by content, never by the name of the file.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "ballbar/circle/recording.hpp"
#include "ballbar/formats/recordings/b5r.hpp"
#include "ballbar/formats/text/log_recipe.hpp"
#include "ballbar/formats/text/reader.hpp"
#include "ballbar/formats/text/source.hpp"

namespace ballbar {

struct RecordingFile {
  std::vector<Recording>
      recordings;  // usually two of a `.b5r`, one of a log, one per run of a table; empty: a `.b5r` with results only
  std::optional<B5r> b5r;              // stored results and equipment, where the file is a `.b5r`; its
                                       // runs and remarks are moved out
  std::vector<std::string> remarks{};  // whole sentences with name:line:column
};

// What the user states about a circle if the file does not (circle_table.hpp). Other formats ignore it.
struct StatedCircle {
  std::optional<double> radius_mm;  // nominal, above 0; overrides the file
  LogRecipe table;                  // how it is read, units of columns; open_recording() takes that of the source
};

// Whether the content looks like a recording: a .b5r, an archive with one, a log or a table. It may still have faults.
bool is_recording_file(const Source& source, std::span<const Reader> readers = known_readers());

// A path into an archive, or an archive with one `.b5r` file, counts as a `.b5r` (archive.hpp). Throws Error, with the
// known formats if none fits.
RecordingFile open_recording(const Source& source, std::span<const Reader> readers = known_readers(),
                             const StatedCircle& stated = {});

// Whether two linear axes drive the recording. Reads only the head of the file and does not report its faults.
bool is_of_linear_axes(const Source& file);

// Throws Error if the file has no readings.
void expect_readings(const RecordingFile& file, const std::filesystem::path& path);

}  // namespace ballbar
