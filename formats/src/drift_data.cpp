#include "ballbar/formats/drift_data.hpp"

#include <string>

#include "ballbar/formats/bytes.hpp"
#include "ballbar/formats/series_csv.hpp"
#include "content.hpp"

namespace ballbar {

Series open_series(const std::filesystem::path& path) {
  return read_series(read_bytes(path, kLargestTable), path.string());
}

DriftData open_drift_data(const std::filesystem::path& path) {
  DriftData data;
  std::error_code error;
  if (std::filesystem::is_regular_file(path, error)) {
    const std::string bytes = read_bytes(path, kLargestTable);
    if (content_of(bytes) == Content::series) {
      data.series = read_series(bytes, path.string());
      data.files = {path};
      return data;
    }
  }
  data.session = open_session(path);
  data.files = data.session->files;
  return data;
}

}  // namespace ballbar
