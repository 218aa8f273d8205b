#include "ballbar/formats/recordings/recording_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "ballbar/error.hpp"
#include "ballbar/formats/recordings/ballbar_log.hpp"
#include "ballbar/formats/text/bytes.hpp"
#include "recordings/content.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kSniffed = std::size_t{1} << 16;  // a header is far shorter

// The first line `format = "NAME ..."`, with or without `#`; empty if there is none before the first row.
std::string_view format_name(std::string_view bytes) {
  while (!bytes.empty()) {
    std::string_view line = bytes.substr(0, bytes.find('\n'));
    bytes.remove_prefix(std::min(line.size() + 1, bytes.size()));
    const auto skip = [&](std::string_view skipped) {
      line.remove_prefix(std::min(line.find_first_not_of(skipped), line.size()));
    };
    skip("# \t");
    if (!line.starts_with("format")) continue;
    line.remove_prefix(6);
    skip(" \t");
    if (!line.starts_with('=')) continue;
    line.remove_prefix(1);
    skip(" \t");
    if (!line.starts_with('"') && !line.starts_with('\'')) continue;
    line.remove_prefix(1);
    return line.substr(0, line.find_first_of(" \"'\r"));
  }
  return {};
}

}  // namespace

Content content_of(std::string_view bytes) {
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);
  bytes = bytes.substr(0, kSniffed);
  const std::size_t first = bytes.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return Content::empty;
  if (bytes.find('\0') != std::string_view::npos) return Content::binary;
  if (bytes[first] == '<') return Content::xml;
  const std::string_view format = format_name(bytes);
  if (format == "ballbar-log") return Content::ballbar_log;
  if (format == "ballbar-series") return Content::series;
  if (format == "ballbar-session") return Content::session;
  if (format == "ballbar-model") return Content::model;
  std::size_t line = first;
  while (line < bytes.size() && bytes[line] == '#') line = std::min(bytes.find('\n', line), bytes.size() - 1) + 1;
  const std::string_view head = bytes.substr(std::min(line, bytes.size()));
  if (head.starts_with("time_s,angle_deg") || head.starts_with("angle_deg")) return Content::table;
  if (head.starts_with("time_s,") || head.starts_with("time_min,")) return Content::series;
  return Content::unknown;
}

std::string_view description(Content content) {
  switch (content) {
    case Content::empty:
      return "an empty file";
    case Content::binary:
      return "a binary file";
    case Content::xml:
      return "XML, such as a .b5r file";
    case Content::ballbar_log:
      return "a ballbar log";
    case Content::series:
      return "a series of columns over time";
    case Content::session:
      return "a session";
    case Content::model:
      return "a model";
    case Content::table:
      return "a ballbar log without its header (# format = \"ballbar-log 1\" and so on)";
    case Content::unknown:
      break;
  }
  return "text of no known format";
}

RecordingFile open_recording(const std::filesystem::path& path) {
  const std::string bytes = read_bytes(path, kLargestTable);
  const std::string name = path.string();
  const Content content = content_of(bytes);
  RecordingFile file;
  if (content == Content::xml) {
    if (bytes.size() > kLargestText) {
      throw Error(fmt::format("{}: expected at most {} MiB of XML, found a larger file.", name, kLargestText >> 20));
    }
    file.b5r = read_b5r(bytes, name);
    file.recordings = std::exchange(file.b5r->runs, {});
  } else if (content == Content::ballbar_log) {
    file.recordings.push_back(read_ballbar_log(bytes, name));
  } else {
    throw Error(
        fmt::format("{}:1:1: expected a recording, which is a Renishaw .b5r file (XML) or a ballbar log (a table whose "
                    "first lines say # format = \"ballbar-log 1\"), found {}.",
                    name, description(content)));
  }
  return file;
}

}  // namespace ballbar
