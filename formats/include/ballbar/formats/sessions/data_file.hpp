// The argument DATA of the commands that fit models: a series, a session with its signals, or recordings.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ballbar/drift/drift.hpp"
#include "ballbar/effects/effect.hpp"
#include "ballbar/formats/recordings/recording_file.hpp"
#include "ballbar/formats/sessions/drift_data.hpp"
#include "ballbar/formats/text/reader.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

struct ModelData {
  Level level = Level::series;
  std::shared_ptr<const Series> series;  // target and inputs on one clock; for recordings trace_of() them
  std::vector<std::string>
      targets;  // possible targets: the measured columns in um, else all measured columns; without sigmas
  std::vector<std::filesystem::path> files;  // all files that were read
  std::string title;
  std::optional<Motion> motion;      // recordings: their common motion
  std::vector<std::string> remarks;  // whole lines: how a log was interpreted
};

// A session gives its drift (drift_of() with the options) merged with its signals. A series has its gaps closed as in
// merged(), which max_gap_s is for; rows that this leaves out are a remark. One or more recordings (.b5r, logs) of one
// plane give their trace. Several runs come from a list of runs, the sheets of a workbook with the same column names,
// or the logs of a folder without recordings. Throws Error for anything else, a mixture, or the same file twice.
ModelData open_model_data(const std::vector<Source>& sources, const DriftOptions& options,
                          std::optional<double> max_gap_s, std::span<const Reader> readers = known_readers(),
                          const StatedCircle& stated = {});

// Whether a source contains several runs. Throws Error for a damaged workbook.
bool stands_for_runs(const Source& source, std::span<const Reader> readers = known_readers());

// The same for a series or a session that is already open. A series without gaps is not copied.
ModelData model_data_of(const DriftData& source, const std::string& name, const DriftOptions& options,
                        std::optional<double> max_gap_s, std::span<const Reader> readers = known_readers());

// One series whose probes were set to zero behind pauses of more than 8 h, as several runs, and a remark that says so;
// anything else unchanged. open_model_data() does so itself.
ModelData with_own_zeros(ModelData data);

// Where model_data_of() throws for the rows within gaps: the longest, as longest_gap() of its parts.
std::optional<SignalGap> longest_gap(const DriftData& source, std::optional<double> max_gap_s,
                                     std::span<const Reader> readers = known_readers());

}  // namespace ballbar
