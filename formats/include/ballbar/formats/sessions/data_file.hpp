// DATA of the commands that fit models: a series, a session with its signals, or recordings.
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
  std::shared_ptr<const Series> series;  // target and inputs on one clock; recordings: trace_of them
  std::vector<std::string>
      targets;  // what a model could explain: the measured columns in um, else the measured columns; no sigmas
  std::vector<std::filesystem::path> files;  // all that were read
  std::string title;
  std::optional<Motion> motion;      // recordings: what drove all of them
  std::vector<std::string> remarks;  // what a log was taken for, whole lines
};

// A list of runs, the sheets of a workbook under the same names and the logs of a folder without recordings are runs.
// A session: its drift (drift_of with the options) merged with its signals; a series: its gaps closed as `merged` does;
// one or more recordings (.b5r, logs) of one plane: their trace. Throws Error for anything else, a mixture, or the same
// file twice.
ModelData open_model_data(const std::vector<Source>& sources, const DriftOptions& options, double max_gap_s,
                          std::span<const Reader> readers = known_readers(), const StatedCircle& stated = {});

// Whether a source stands for several runs. Throws Error where it is a damaged workbook.
bool stands_for_runs(const Source& source, std::span<const Reader> readers = known_readers());

// The same of a series or a session that is open already. A series in which nothing is to be closed is not copied.
ModelData model_data_of(const DriftData& source, const std::string& name, const DriftOptions& options, double max_gap_s,
                        std::span<const Reader> readers = known_readers());

}  // namespace ballbar
