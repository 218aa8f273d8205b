#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "ballbar/circle/recording.hpp"
#include "ballbar/error.hpp"
#include "ballbar/units.hpp"
#include "numerics/not_finite.hpp"

namespace ballbar {
namespace {

constexpr double kBetweenSweeps_s = 1.0;

constexpr std::array<std::pair<std::string_view, std::string_view>, 11> kColumns = {{
    {"angle", "angle_rad"},
    {"direction", "direction"},
    {"feed", "feed_mm_per_min"},
    {"radius", "radius_mm"},
    {"height", "height_mm"},
    {"sweep", "sweep_s"},
    {"bar", "bar_degC"},
    {"recording", "recording"},
    {"linear_axes", "linear_axes"},
    {"pitch_a", "pitch_a_mm"},
    {"pitch_b", "pitch_b_mm"},
}};

// From one reading to the next where the recording has no times: T / n with the sweep's time T = L arc / V.
double interval_s(const Recording& recording) {
  const double feed_mm_per_min = recording.feed_mm_per_min.value_or(0.0);
  const double arc = arc_rad(recording);
  if (!(feed_mm_per_min > 0.0) || !(arc > 0.0)) return 1.0;
  return recording.nominal_length_mm * arc / (feed_mm_per_min / 60.0) / static_cast<double>(recording.length_mm.size());
}

// n times from the first reading.
std::vector<double> times_s(const Recording& recording, std::size_t number) {
  std::vector<double> times(recording.length_mm.size());
  if (recording.time_s.empty()) {
    const double step_s = interval_s(recording);
    for (std::size_t i = 0; i < times.size(); ++i) times[i] = static_cast<double>(i) * step_s;
    return times;
  }
  for (std::size_t i = 0; i < times.size(); ++i) {
    times[i] = recording.time_s[i] - recording.time_s[0];
    if (i > 0 && !(times[i] > times[i - 1])) {
      throw Error(
          fmt::format("recording {}, reading {}: expected a time after the {} s of the reading before it, "
                      "found {} s.",
                      number + 1, i + 1, recording.time_s[i - 1], recording.time_s[i]));
    }
  }
  return times;
}

}  // namespace

Series trace_of(std::span<const Recording> recordings) {
  std::size_t n = 0;
  for (std::size_t k = 0; k < recordings.size(); ++k) {
    if (recordings[k].kind == Kind::axial) {
      throw Error(
          fmt::format("recording {}: expected a circle, found an axial recording, which has no angles.", k + 1));
    }
    n += recordings[k].length_mm.size();
  }
  Series trace;
  trace.time_s.reserve(n);
  trace.columns.push_back({"deviation_um", Role::measured, {}});
  for (const auto& [role, column] : kColumns) trace.columns.push_back({std::string(column), Role::event, {}});
  for (Column& column : trace.columns) column.values.reserve(n);

  double start_s = 0.0;
  for (std::size_t k = 0; k < recordings.size(); ++k) {
    const Recording& recording = recordings[k];
    const std::vector<double> times = times_s(recording, k);
    if (times.empty()) continue;
    const double middle_s = times.back() / 2.0;
    const double direction = recording.direction == Direction::CCW ? 1.0 : -1.0;
    for (std::size_t i = 0; i < times.size(); ++i) {
      trace.time_s.push_back(start_s + times[i]);
      const std::array row = {um_from_mm(recording.length_mm[i] - recording.nominal_length_mm),
                              recording.angle_rad[i],
                              direction,
                              recording.feed_mm_per_min.value_or(kUnknown),
                              recording.nominal_length_mm,
                              recording.height_offset_mm,
                              times[i] - middle_s,
                              recording.bar_temperature_degC.value_or(kUnknown),
                              static_cast<double>(k),
                              recording.motion == Motion::linear_axes ? 1.0 : 0.0,
                              recording.pitch_a_mm.value_or(kUnknown),
                              recording.pitch_b_mm.value_or(kUnknown)};
      static_assert(std::tuple_size_v<decltype(row)> == 1 + kColumns.size());
      for (std::size_t column = 0; column < row.size(); ++column) trace.columns[column].values.push_back(row[column]);
    }
    start_s = trace.time_s.back() + kBetweenSweeps_s;
  }
  return trace;
}

std::string_view trace_column(std::string_view role) {
  const auto* const entry =
      std::find_if(kColumns.begin(), kColumns.end(), [&](const auto& pair) { return pair.first == role; });
  return entry == kColumns.end() ? std::string_view{} : entry->second;
}

}  // namespace ballbar
