#include "ballbar/formats/recordings/ballbar_log.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "ballbar/error.hpp"
#include "ballbar/formats/recordings/recording_file.hpp"
#include "ballbar/units.hpp"
#include "text/head.hpp"
#include "text/readers.hpp"
#include "text/table.hpp"
#include "text/toml_source.hpp"

namespace ballbar {
namespace {

constexpr std::string_view kFormat = "ballbar-log 1";

constexpr Key kKeys[] = {
    {"format", "text", "\"ballbar-log 1\"; needed"},
    {"kind", "text", "\"circle\", or \"axial\": a bar along the spindle's axis, without angle; needed"},
    {"motion", "text", "what drives the circle: \"linear_axes\", \"rotary_axis\" or \"spindle\"; a circle needs it"},
    {"plane", "text", "\"XY\", \"YZ\" or \"ZX\", or axes exchanged, such as \"XZ\"; a circle needs it"},
    {"moving_ball", "text", "which ball travels, \"spindle\" or \"table\"; a circle needs it"},
    {"nominal_length_mm", "mm", "of the bar, above 0; needed"},
    {"direction", "text", "\"CCW\" or \"CW\", as the angles run; a circle needs it"},
    {"elapsed_s", "s", "start of the test from the session's own zero"},
    {"started", "date and time", "start on the machine's clock, 2015-03-02T09:00:00, no zone"},
    {"feed_mm_per_min", "mm/min", "feed on the path, above 0"},
    {"height_offset_mm", "mm", "height of the moving ball over the fixed one, along the plane's normal; default 0"},
    {"bar_temperature_degC", "degC", "temperature of the bar"},
};
constexpr std::string_view kOnlyOfCircles[] = {"motion", "plane", "moving_ball"};

Recording header_of(const TomlTable& header) {
  expect_format(header, kFormat);
  Recording recording;
  recording.kind = required_choice(header, "kind", {Kind::circle, Kind::axial});
  if (recording.kind == Kind::circle) {
    expect_keys(header, kKeys);
    recording.motion = required_choice(header, "motion", {Motion::linear_axes, Motion::rotary_axis, Motion::spindle});
    const std::optional<Plane> plane = choice(header, "plane", std::span<const Plane>(kPlanes));
    if (!plane) fail_missing(header, "plane");
    recording.plane = *plane;
    recording.moving_ball = required_choice(header, "moving_ball", {MovingBall::spindle, MovingBall::table});
    recording.direction = required_choice(header, "direction", {Direction::CCW, Direction::CW});
  } else {
    std::vector<std::string_view> known = names_of(kKeys);
    for (const std::string_view key : kOnlyOfCircles) {
      if (has(header, key))
        fail_at_key(header, key, fmt::format("expected no {} in an axial log, found one; only a circle has it.", key));
      std::erase(known, key);
    }
    expect_keys(header, known);
    recording.direction = choice(header, "direction", {Direction::CCW, Direction::CW}).value_or(Direction::CCW);
  }
  recording.nominal_length_mm = required(positive, header, "nominal_length_mm");
  recording.height_offset_mm = number(header, "height_offset_mm").value_or(0.0);
  recording.feed_mm_per_min = positive(header, "feed_mm_per_min");
  recording.bar_temperature_degC = number(header, "bar_temperature_degC");
  recording.elapsed_s = number(header, "elapsed_s");
  recording.started_s = local_time_s(header, "started");
  return recording;
}

struct LogColumns {
  std::optional<std::size_t> time, angle, length, deviation;
};

LogColumns log_columns(const SourceText& text, const TableHead& head, Kind kind) {
  LogColumns columns;
  const bool circle = kind == Kind::circle;
  for (std::size_t i = 0; i < head.columns.size(); ++i) {
    const ColumnName& column = head.columns[i];
    if (column.name == "time_s") {
      columns.time = i;
    } else if (column.name == "angle_deg" && circle) {
      columns.angle = i;
    } else if (column.name == "length_mm") {
      columns.length = i;
    } else if (column.name == "deviation_um") {
      columns.deviation = i;
    } else {
      fail_at(text, column.offset,
              fmt::format(
                  "expected one of the columns time_s,{} length_mm, deviation_um in {} log, in these units, found {}.",
                  circle ? " angle_deg," : "", circle ? "a circle" : "an axial", in_quotes(column.name)));
    }
  }
  if (circle) expect_column(text, head, columns.angle.has_value(), "angle_deg");
  if (!circle) expect_column(text, head, columns.time.has_value(), "time_s");
  expect_column(text, head, columns.length || columns.deviation, "length_mm (or deviation_um)");
  if (columns.length && columns.deviation) {
    fail_at(text, head.columns[*columns.deviation].offset, "expected either length_mm or deviation_um, found both.");
  }
  return columns;
}

// Steps on the circle, each at most half a turn: they tell the direction where all agree.
void expect_direction(const TomlTable& header, const Recording& recording) {
  bool rises = false;
  bool falls = false;
  for (std::size_t i = 1; i < recording.angle_rad.size(); ++i) {
    const double step_rad = std::remainder(recording.angle_rad[i] - recording.angle_rad[i - 1], 2.0 * kPi);
    rises = rises || step_rad > 0.0;
    falls = falls || step_rad < 0.0;
  }
  if (rises == falls) return;
  const Direction found = rises ? Direction::CCW : Direction::CW;
  if (found == recording.direction) return;
  fail_at_key(header, "direction",
              fmt::format("expected the direction of the angles, which {} all the way ({}), found \"{}\".",
                          rises ? "rise" : "fall", name_of(found), name_of(recording.direction)));
}

RecordingFile log_file(std::string_view bytes, std::string_view name) {
  return {{read_ballbar_log(bytes, name)}, std::nullopt};
}

// 90.18 rather than 90.18000000000001, where that reads back to the same angle.
double written_deg(double angle_rad) {
  const double angle_deg = deg_from_rad(angle_rad);
  const double shorter_deg = std::round(angle_deg * 1e9) / 1e9;
  return rad_from_deg(shorter_deg) == angle_rad ? shorter_deg : angle_deg;
}

}  // namespace

std::vector<KeyTable> log_keys() { return {{"", kKeys}}; }

constinit const Reader readers::kBallbarLog = {
    .found = "a ballbar log",
    .recording = "a ballbar log (a table whose first lines say # format = \"ballbar-log 1\")",
    .is_yours = [](std::string_view head) { return format_name(head) == "ballbar-log"; },
    .read = log_file,
};

// Not to be read, but meant as a recording: as such it is told what it lacks.
constinit const Reader readers::kLogWithoutHeader = {
    .found = "a ballbar log without its header (# format = \"ballbar-log 1\" and so on)",
    .is_yours =
        [](std::string_view head) {
          const std::string_view table = after_comments(head);
          return table.starts_with("time_s,angle_deg") || table.starts_with("angle_deg");
        },
    .read = ReadRecordings{},
};

Recording read_ballbar_log_header(std::string_view bytes, std::string_view name) {
  const TomlSource source = parse_toml(comment_block(source_text(bytes, name)).toml, name);
  return header_of(root_of(source));
}

Recording read_ballbar_log(std::string_view bytes, std::string_view name) {
  const SourceText text = source_text(bytes, name);
  const CommentBlock comments = comment_block(text);
  const TomlSource source = parse_toml(comments.toml, name);
  const TomlTable header = root_of(source);
  Recording recording = header_of(header);
  const TableHead head = table_head(text, comments.end);
  const LogColumns columns = log_columns(text, head, recording.kind);
  std::vector<std::vector<double>> values = table_columns(text, head, false);

  if (columns.time) {
    expect_rising(text, head, *columns.time, values[*columns.time]);
    recording.time_s = std::move(values[*columns.time]);
  }
  if (columns.angle) {
    recording.angle_rad = std::move(values[*columns.angle]);
    for (double& angle : recording.angle_rad) angle = rad_from_deg(angle);
    expect_direction(header, recording);
  }
  const std::size_t column = columns.length ? *columns.length : *columns.deviation;
  recording.length_mm = std::move(values[column]);
  if (columns.deviation) {
    for (double& length : recording.length_mm) length = recording.nominal_length_mm + mm_from_um(length);
  }
  const auto wrong = std::find_if(recording.length_mm.begin(), recording.length_mm.end(),
                                  [](double length) { return !(length > 0.0); });
  if (wrong != recording.length_mm.end()) {
    fail_at_cell(text, head, static_cast<std::size_t>(wrong - recording.length_mm.begin()), column,
                 columns.length ? "a length above 0 mm" : "a deviation that leaves a length above 0 mm");
  }
  // A bar measures a millimetre or two about its nominal length; a tenth of it is another unit or another bar.
  const auto far = std::find_if(recording.length_mm.begin(), recording.length_mm.end(), [&](double length) {
    return std::abs(length - recording.nominal_length_mm) > 0.1 * recording.nominal_length_mm;
  });
  if (far != recording.length_mm.end()) {
    fail_at_cell(text, head, static_cast<std::size_t>(far - recording.length_mm.begin()), column,
                 fmt::format("a {} within a tenth of nominal_length_mm = {}",
                             columns.length ? "length in mm" : "deviation in um", recording.nominal_length_mm));
  }
  return recording;
}

std::string write_ballbar_log(const Recording& recording) {
  fmt::memory_buffer out;
  const auto to = std::back_inserter(out);
  const auto optional = [&](std::string_view key, const std::optional<double>& value) {
    if (value) fmt::format_to(to, "# {} = {}\n", key, toml_number(*value));
  };
  const bool circle = recording.kind == Kind::circle;
  fmt::format_to(to, "# format = \"{}\"\n# kind = \"{}\"\n", kFormat, name_of(recording.kind));
  if (circle) {
    fmt::format_to(to, "# motion = \"{}\"\n# plane = \"{}\"\n# moving_ball = \"{}\"\n", name_of(recording.motion),
                   name_of(recording.plane), name_of(recording.moving_ball));
  }
  optional("nominal_length_mm", recording.nominal_length_mm);
  if (circle) fmt::format_to(to, "# direction = \"{}\"\n", name_of(recording.direction));
  optional("elapsed_s", recording.elapsed_s);
  if (recording.started_s) fmt::format_to(to, "# started = {}\n", toml_local_time(*recording.started_s));
  optional("feed_mm_per_min", recording.feed_mm_per_min);
  if (recording.height_offset_mm != 0.0) optional("height_offset_mm", recording.height_offset_mm);
  optional("bar_temperature_degC", recording.bar_temperature_degC);

  const bool timed = !recording.time_s.empty();
  fmt::format_to(to, "{}{}length_mm\n", timed ? "time_s," : "", circle ? "angle_deg," : "");
  for (std::size_t i = 0; i < recording.length_mm.size(); ++i) {
    if (timed) fmt::format_to(to, "{},", recording.time_s[i]);
    if (circle) fmt::format_to(to, "{},", written_deg(recording.angle_rad[i]));
    fmt::format_to(to, "{}\n", recording.length_mm[i]);
  }
  return fmt::to_string(out);
}

}  // namespace ballbar
