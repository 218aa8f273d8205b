#include "ballbar/formats/sessions/drift_data.hpp"

#include <fmt/format.h>

#include <string>
#include <utility>

#include "ballbar/error.hpp"
#include "ballbar/formats/logs/log.hpp"
#include "ballbar/formats/series/series_csv.hpp"
#include "ballbar/formats/text/archive.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "ballbar/formats/text/given_data.hpp"

namespace ballbar {

namespace {

OpenedSeries opened_by(const Reader* reader, const std::filesystem::path& path, const LogRecipe& recipe) {
  if (const auto read = read_of<ReadLog>(reader)) {
    Log log = read(path, recipe);
    OpenedSeries opened;
    opened.remarks.push_back(fmt::format("{}: {}", path.string(), sentence_of(log)));
    for (const std::string& remark : log.remarks)
      opened.remarks.push_back(fmt::format("{}: {}", path.string(), remark));
    opened.series = std::move(log.series);
    return opened;
  }
  const auto read = read_of<ReadSeries>(reader);
  // Which tells the faults of what is no series.
  return {(read != nullptr ? read : read_series)(read_bytes(path, kLargestTable), path.string()), {}};
}

}  // namespace

OpenedSeries opened_series(const std::filesystem::path& path, std::span<const Reader> readers,
                           const LogRecipe& recipe) {
  if (const Series* const given = given_series(path)) return {*given, {}};
  return opened_by(reader_of(read_head(path, kHeadBytes), readers), path, recipe);
}

Series open_series(const std::filesystem::path& path, std::span<const Reader> readers) {
  return opened_series(path, readers).series;
}

DriftData open_drift_data(const std::filesystem::path& path, std::span<const Reader> readers) {
  DriftData data;
  if (const Series* const given = given_series(path)) {
    data.series = *given;
    return data;
  }
  std::error_code error;
  if (std::filesystem::is_regular_file(path, error) && !is_archive(path)) {
    const Reader* const reader = reader_of_file(path, readers);
    if (reads_series(reader)) {
      OpenedSeries opened = opened_by(reader, path, {});
      data.series = std::move(opened.series);
      data.remarks = std::move(opened.remarks);
      data.files = {path};
      return data;
    }
    if (reader != nullptr && read_of<ReadSession>(reader) == nullptr) {
      throw Error(fmt::format(
          "{}:1:1: expected a session, which is a folder or a file that says format = \"ballbar-session 1\", or a "
          "series of columns over time, found {}.",
          path.string(), found_in(reader)));
    }
  }
  data.session = open_session(path, readers);
  data.files = data.session->files;
  return data;
}

}  // namespace ballbar
