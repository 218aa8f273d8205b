#include "ballbar/formats/schedules/schedule_csv.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <vector>

#include "ballbar/error.hpp"
#include "text/head.hpp"
#include "text/readers.hpp"
#include "text/table.hpp"
#include "text/toml_source.hpp"

namespace ballbar {
namespace {

constexpr std::string_view kFormat = "ballbar-schedule 1";
constexpr std::string_view kStarts[] = {"cold", "warm"};
constexpr std::string_view kBegin = "begin_min", kDuration = "duration_min";
constexpr double kBeginTolerance_min = 1e-3;

constexpr std::size_t kMostDwells = 10000;
constexpr double kShortestDwell_s = 1e-3;  // what controls can keep
constexpr double kLongestSchedule_s = 31.0 * 24.0 * 3600.0;

// A number of a dwell, as the file has it: its column, the value of a dwell, and what it may be.
struct DwellColumn {
  std::string_view name;
  double Dwell::*member = nullptr;
  double lowest = 0.0, highest = 0.0;
  std::string_view expected;  // after "expected"
};

constexpr std::array<DwellColumn, 4> kDwellColumns = {{
    {"speed_rpm", &Dwell::speed_rpm, 0.0, 1e6, "a speed of 0 to 1000000 rpm"},
    {"load", &Dwell::load, 0.0, 100.0, "a load of 0 to 100 times that of the data"},
    {"room_K", &Dwell::room_K, -100.0, 100.0, "a room within 100 K of that of the data"},
    {"coolant_K", &Dwell::coolant_K, -100.0, 100.0, "a coolant within 100 K of that of the data"},
}};
constexpr std::string_view kExpectedDuration = "a duration of 1 ms to 31 days";

constexpr Key kKeys[] = {
    {"format", "text", "\"ballbar-schedule 1\"; needed"},
    {"reading_s", "s", "a reading of the target every so often; default 60"},
    {"starts", "text",
     "\"cold\", after a night at rest, the default, or \"warm\": while the machine still moves from what it did "
     "before"},
};

bool within(const DwellColumn& column, double value) {  // no for what is not finite
  return value >= column.lowest && value <= column.highest;
}

bool is_duration(double duration_s) { return duration_s >= kShortestDwell_s && duration_s <= kLongestSchedule_s; }

// To the microsecond, which minutes of a double hold over 31 days: 1/3 min is 20 s again.
double seconds_of(double min) { return std::round(min * 60e6) / 1e6; }

// Minutes of the fewest decimals that read back to the same time.
std::string minutes_text(double duration_s) {
  const double min = duration_s / 60.0, to_s = seconds_of(min);
  std::string text;
  for (int decimals = 0; decimals <= 12; ++decimals) {
    text = fmt::format("{:.{}f}", min, decimals);
    double read_min = 0.0;
    std::from_chars(text.data(), text.data() + text.size(), read_min);
    if (seconds_of(read_min) == to_s) break;
  }
  return text;
}

struct Columns {
  std::optional<std::size_t> begin, duration;
  std::array<std::optional<std::size_t>, kDwellColumns.size()> others;
};

Columns columns_of(const SourceText& text, const TableHead& head) {
  Columns columns;
  for (std::size_t i = 0; i < head.columns.size(); ++i) {
    const ColumnName& column = head.columns[i];
    bool known = column.name == kBegin || column.name == kDuration;
    if (column.name == kBegin) columns.begin = i;
    if (column.name == kDuration) columns.duration = i;
    for (std::size_t k = 0; k < kDwellColumns.size(); ++k) {
      if (column.name != kDwellColumns[k].name) continue;
      columns.others[k] = i;
      known = true;
    }
    if (known) continue;
    fail_at(text, column.offset,
            fmt::format("expected one of the columns begin_min, duration_min, speed_rpm, load, room_K, coolant_K, "
                        "found {}.",
                        in_quotes(column.name)));
  }
  expect_column(text, head, columns.duration.has_value(), kDuration);
  expect_column(text, head, columns.others[0].has_value(), kDwellColumns[0].name);
  return columns;
}

void read_header(Schedule& schedule, const TomlTable& header) {
  expect_format(header, kFormat);
  expect_keys(header, kKeys);
  schedule.reading_s = positive(header, "reading_s").value_or(schedule.reading_s);
  if (!is_duration(schedule.reading_s)) {
    fail_at_key(header, "reading_s",
                fmt::format("expected 0.001 s to 31 days for reading_s, found {} s.", schedule.reading_s));
  }
  schedule.starts_warm = choice_index(header, "starts", kStarts).value_or(0) == 1;
}

}  // namespace

std::vector<KeyTable> schedule_keys() { return {{"", kKeys}}; }

constinit const Reader readers::kSchedule = {
    .found = "the schedule of a test",
    .is_yours = [](std::string_view head) { return format_name(head) == "ballbar-schedule"; },
};

void expect_schedule(const Schedule& schedule) {
  if (schedule.dwells.empty() || schedule.dwells.size() > kMostDwells) {
    throw Error(fmt::format("The schedule: expected 1 to {} dwells, found {}.", kMostDwells, schedule.dwells.size()));
  }
  for (std::size_t i = 0; i < schedule.dwells.size(); ++i) {
    const Dwell& dwell = schedule.dwells[i];
    const auto fail = [&](std::string_view expected, const std::string& found) {
      throw Error(fmt::format("Dwell {} of the schedule: expected {}, found {}.", i + 1, expected, found));
    };
    if (!is_duration(dwell.duration_s)) fail(kExpectedDuration, fmt::format("{} s", dwell.duration_s));
    for (const DwellColumn& column : kDwellColumns) {
      if (!within(column, dwell.*column.member)) fail(column.expected, fmt::format("{}", dwell.*column.member));
    }
  }
  if (!is_duration(duration_s(schedule))) {
    throw Error(fmt::format("The schedule: expected 31 days at most, found {} days.", duration_s(schedule) / 86400.0));
  }
  if (!is_duration(schedule.reading_s)) {
    throw Error(
        fmt::format("The schedule: expected a reading every 1 ms to 31 days, found every {} s.", schedule.reading_s));
  }
}

std::string write_schedule_csv(const Schedule& schedule) {
  expect_schedule(schedule);
  std::string out =
      fmt::format("# format = \"{}\"\n# reading_s = {}\n# starts = \"{}\"\n{},{}", kFormat,
                  toml_number(schedule.reading_s), kStarts[schedule.starts_warm ? 1 : 0], kBegin, kDuration);
  for (const DwellColumn& column : kDwellColumns) out += fmt::format(",{}", column.name);
  out += '\n';
  double begin_s = 0.0;
  for (const Dwell& dwell : schedule.dwells) {
    out += fmt::format("{},{}", minutes_text(begin_s), minutes_text(dwell.duration_s));
    for (const DwellColumn& column : kDwellColumns) out += fmt::format(",{}", dwell.*column.member);
    out += '\n';
    begin_s += dwell.duration_s;
  }
  return out;
}

Schedule read_schedule_csv(std::string_view bytes, std::string_view name) {
  const SourceText text = source_text(bytes, name);
  const CommentBlock comments = comment_block(text);
  const TomlSource source = parse_toml(comments.toml, name);
  Schedule schedule;
  read_header(schedule, root_of(source));
  const TableHead head = table_head(text, comments.end);
  const Columns columns = columns_of(text, head);
  const std::vector<std::vector<double>> values = table_columns(text, head, false);
  const std::size_t rows = values.front().size();
  if (rows > kMostDwells)
    fail_at(text, head.body, fmt::format("expected at most {} rows, found {}.", kMostDwells, rows));
  schedule.dwells.reserve(rows);
  double end_s = 0.0;
  for (std::size_t row = 0; row < rows; ++row) {
    if (columns.begin && !(std::abs(values[*columns.begin][row] - end_s / 60.0) <= kBeginTolerance_min)) {
      fail_at_cell(text, head, row, *columns.begin,
                   fmt::format("{} min for begin_min, where the row before ends", minutes_text(end_s)));
    }
    Dwell dwell;
    dwell.duration_s = seconds_of(values[*columns.duration][row]);
    end_s += dwell.duration_s;
    if (!is_duration(dwell.duration_s)) fail_at_cell(text, head, row, *columns.duration, kExpectedDuration);
    if (!is_duration(end_s)) fail_at_cell(text, head, row, *columns.duration, "31 days at most in all");
    for (std::size_t k = 0; k < kDwellColumns.size(); ++k) {
      if (!columns.others[k]) continue;
      const double value = values[*columns.others[k]][row];
      if (!within(kDwellColumns[k], value)) {
        fail_at_cell(text, head, row, *columns.others[k], kDwellColumns[k].expected);
      }
      dwell.*kDwellColumns[k].member = value;
    }
    schedule.dwells.push_back(dwell);
  }
  return schedule;
}

}  // namespace ballbar
