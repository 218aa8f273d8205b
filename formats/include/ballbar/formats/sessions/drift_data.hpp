// Opens data with a drift: a session, a folder of recordings, or a series. Recognised by content, not by name.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ballbar/formats/logs/log.hpp"
#include "ballbar/formats/sessions/session_toml.hpp"
#include "ballbar/formats/text/reader.hpp"
#include "ballbar/formats/text/source.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

// Either a session or a series.
struct DriftData {
  std::optional<SessionFiles> session;
  std::shared_ptr<const Series> series;
  std::vector<std::filesystem::path> files;  // all files that were read
  std::vector<std::string> remarks;          // whole lines: how a log was interpreted; empty for a ballbar series
};

// A series with the remarks of its reader.
struct OpenedSeries {
  std::shared_ptr<const Series> series;
  std::vector<std::string> remarks;
};
OpenedSeries opened_series(const Source& source, std::span<const Reader> readers = known_readers());

// Throws Error, with what was found, if the file is neither.
DriftData open_drift_data(const Source& source, std::span<const Reader> readers = known_readers());

Series open_series(const Source& source, std::span<const Reader> readers = known_readers());

}  // namespace ballbar
