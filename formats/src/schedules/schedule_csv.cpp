#include "ballbar/formats/schedules/schedule_csv.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>

#include "ballbar/error.hpp"
#include "text/head.hpp"
#include "text/readers.hpp"
#include "text/toml_source.hpp"

namespace ballbar {
namespace {

constexpr std::string_view kFormat = "ballbar-schedule 1";
constexpr std::string_view kStarts[] = {"cold", "warm"};
constexpr std::string_view kBegin = "begin_min", kDuration = "duration_min";

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

}  // namespace

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

}  // namespace ballbar
