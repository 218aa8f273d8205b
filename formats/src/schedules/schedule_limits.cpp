#include "schedules/schedule_limits.hpp"

#include <fmt/format.h>

#include "ballbar/error.hpp"
#include "ballbar/formats/schedules/schedule_csv.hpp"

namespace ballbar {

bool within(const DwellColumn& column, double value) { return value >= column.lowest && value <= column.highest; }

bool is_duration(double duration_s) { return duration_s >= kShortestDwell_s && duration_s <= kLongestSchedule_s; }

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

}  // namespace ballbar
