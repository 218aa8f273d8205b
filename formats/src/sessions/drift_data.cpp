#include "ballbar/formats/sessions/drift_data.hpp"

#include <fmt/format.h>

#include <string>
#include <utility>

#include "ballbar/error.hpp"
#include "ballbar/formats/logs/log.hpp"
#include "ballbar/formats/series/series_csv.hpp"
#include "ballbar/formats/text/archive.hpp"
#include "ballbar/formats/text/file_bytes.hpp"

namespace ballbar {

namespace {

// Read once: the remarks say how a log was read.
OpenedSeries opened_by(const Reader* reader, const Source& source) {
  if (const auto read = read_of<ReadLog>(reader)) {
    Log log = read(source);
    OpenedSeries opened;
    opened.remarks.push_back(fmt::format("{}: {}", source.title(), sentence_of(log)));
    for (const std::string& remark : log.remarks)
      opened.remarks.push_back(fmt::format("{}: {}", source.title(), remark));
    opened.series = std::make_shared<const Series>(std::move(log.series));
    return opened;
  }
  const auto read = read_of<ReadSeries>(reader);
  // Which tells the faults of what is no series.
  Series series =
      with_stated_columns((read != nullptr ? read : read_series)(source.bytes(kLargestTable), source.name()),
                          source.recipe(), source.name());
  return {std::make_shared<const Series>(std::move(series)), {}};
}

}  // namespace

OpenedSeries opened_series(const Source& source, std::span<const Reader> readers) {
  if (source.series()) return {source.series(), {}};
  return opened_by(source.reader(readers), source);
}

Series open_series(const Source& source, std::span<const Reader> readers) {
  return *opened_series(source, readers).series;
}

DriftData open_drift_data(const Source& source, std::span<const Reader> readers) {
  DriftData data;
  data.series = source.series();
  if (data.series) return data;
  if (source.is_file() && !source.is_archive()) {
    const Reader* const reader = source.reader(readers);
    if (reads_series(reader)) {
      OpenedSeries opened = opened_by(reader, source);
      data.series = std::move(opened.series);
      data.remarks = std::move(opened.remarks);
      data.files = {file_on_disk(source.path())};
      for (const std::string& file : source.recipe().join) data.files.emplace_back(file);
      return data;
    }
    if (reader != nullptr && read_of<ReadSession>(reader) == nullptr) {
      throw Error(
          fmt::format("{}:1:1: expected a session (a folder or a file with format = \"ballbar-session 1\") or a series "
                      "of columns over time, found {}.",
                      source.name(), found_in(reader)));
    }
  }
  data.session = open_session(source, readers);
  data.files = data.session->files;
  data.remarks = data.session->remarks;
  return data;
}

}  // namespace ballbar
