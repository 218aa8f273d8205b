#include "ballbar/formats/sessions/drift_data.hpp"

#include <fmt/format.h>

#include <string>

#include "ballbar/error.hpp"
#include "ballbar/formats/series/series_csv.hpp"
#include "ballbar/formats/text/file_bytes.hpp"

namespace ballbar {

Series open_series(const std::filesystem::path& path, std::span<const Reader> readers) {
  const std::string bytes = read_bytes(path, kLargestTable);
  const auto read = read_of<ReadSeries>(reader_of(bytes, readers));
  return (read != nullptr ? read : read_series)(bytes, path.string());  // which tells the faults of what is no series
}

DriftData open_drift_data(const std::filesystem::path& path, std::span<const Reader> readers) {
  DriftData data;
  std::error_code error;
  if (std::filesystem::is_regular_file(path, error)) {
    const Reader* const reader = reader_of_file(path, readers);
    if (read_of<ReadSeries>(reader) != nullptr) {
      data.series = open_series(path, readers);
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
