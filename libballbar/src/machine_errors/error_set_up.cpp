#include "machine_errors/error_set_up.hpp"

#include <algorithm>
#include <cmath>

#include "ballbar/circle/recording.hpp"

namespace ballbar {
namespace {

constexpr double kFeedOfOneMs_mm_per_min = 60.0;  // a delay of 1 ms is 1 um

const std::vector<double>& values_of(const Series& trace, std::string_view role) {
  return find_column(trace, trace_column(role))->values;
}

std::optional<double> stated(double value) {
  return std::isfinite(value) && value > 0.0 ? std::optional(value) : std::nullopt;
}

}  // namespace

ErrorSetUp set_up_of(const Series& trace) {
  double cos = 0.0, sin = 0.0;
  for (const double angle : values_of(trace, "angle")) cos += std::cos(angle), sin += std::sin(angle);
  return {longest_arc_rad(trace),
          std::atan2(sin, cos),
          values_of(trace, "radius").front(),
          values_of(trace, "height").front(),
          stated(values_of(trace, "pitch_a").front()),
          stated(values_of(trace, "pitch_b").front())};
}

double longest_arc_rad(const Series& trace) {
  const std::vector<double>& angle_rad = values_of(trace, "angle");
  const std::vector<double>& recording = values_of(trace, "recording");
  double longest = 0.0;
  for (std::size_t first = 0, last = 0; first < angle_rad.size(); first = last) {
    while (last < angle_rad.size() && recording[last] == recording[first]) ++last;
    // Readings of a log may stand in any order; then the arc is what they cover.
    Recording one;
    one.angle_rad.assign(angle_rad.begin() + static_cast<long>(first), angle_rad.begin() + static_cast<long>(last));
    one.length_mm.resize(last - first);
    longest = std::max(longest, arc_rad(one));
  }
  return longest;
}

bool states_feed(const Series& trace) {
  const std::vector<double>& feed = values_of(trace, "feed");
  return std::any_of(feed.begin(), feed.end(), [](double value) { return std::isfinite(value); });
}

Series with_feed(Series trace) {
  const double unknown_mm_per_min = states_feed(trace) ? 0.0 : kFeedOfOneMs_mm_per_min;
  for (Column& column : trace.columns) {
    if (column.name != trace_column("feed")) continue;
    for (double& value : column.values) value = std::isfinite(value) ? value : unknown_mm_per_min;
  }
  return trace;
}

}  // namespace ballbar
