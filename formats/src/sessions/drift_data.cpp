#include "ballbar/formats/sessions/drift_data.hpp"

#include <fmt/format.h>

#include <string>

#include "ballbar/error.hpp"
#include "ballbar/formats/series/series_csv.hpp"
#include "ballbar/formats/text/bytes.hpp"
#include "recordings/content.hpp"

namespace ballbar {

Series open_series(const std::filesystem::path& path) {
  return read_series(read_bytes(path, kLargestTable), path.string());
}

DriftData open_drift_data(const std::filesystem::path& path) {
  DriftData data;
  std::error_code error;
  if (std::filesystem::is_regular_file(path, error)) {
    const std::string bytes = read_bytes(path, kLargestTable);
    const Content content = content_of(bytes);
    if (content == Content::series) {
      data.series = read_series(bytes, path.string());
      data.files = {path};
      return data;
    }
    if (content != Content::session && content != Content::unknown) {
      throw Error(fmt::format(
          "{}:1:1: expected a session, which is a folder or a file that says format = \"ballbar-session 1\", or a "
          "series of columns over time, found {}.",
          path.string(), description(content)));
    }
  }
  data.session = open_session(path);
  data.files = data.session->files;
  return data;
}

}  // namespace ballbar
