// The errors of a machine from the trace of its recordings.
#include <algorithm>
#include <cmath>

#include "ballbar/circle/trace.hpp"
#include "ballbar/units.hpp"
#include "machine_errors/error_fit.hpp"

namespace ballbar {
namespace {

const std::vector<double>& values_of(const Series& trace, std::string_view role) {
  return find_column(trace, trace_column(role))->values;
}

std::optional<double> stated(double value) {
  return std::isfinite(value) && value > 0.0 ? std::optional(value) : std::nullopt;
}

// From one reading to the next of a recording the angle goes on by the same step; readings of a log may stand in any
// order, then the arc is what they cover.
double arc_of(std::span<const double> angle_rad) {
  Recording recording;
  recording.angle_rad.assign(angle_rad.begin(), angle_rad.end());
  recording.length_mm.resize(angle_rad.size());
  return arc_rad(recording);
}

ErrorSetUp set_up_of(const Series& trace) {
  ErrorSetUp set_up;
  const std::vector<double>& angle_rad = values_of(trace, "angle");
  const std::vector<double>& recording = values_of(trace, "recording");
  double cos = 0.0, sin = 0.0;
  for (std::size_t first = 0; first < angle_rad.size();) {
    std::size_t last = first;
    while (last < angle_rad.size() && recording[last] == recording[first]) {
      cos += std::cos(angle_rad[last]);
      sin += std::sin(angle_rad[last++]);
    }
    set_up.arc_rad = std::max(set_up.arc_rad, arc_of(std::span(angle_rad).subspan(first, last - first)));
    first = last;
  }
  set_up.middle_rad = std::atan2(sin, cos);
  set_up.length_mm = values_of(trace, "radius").front();
  set_up.height_mm = values_of(trace, "height").front();
  set_up.pitch_a_mm = stated(values_of(trace, "pitch_a").front());
  set_up.pitch_b_mm = stated(values_of(trace, "pitch_b").front());
  return set_up;
}

}  // namespace

ErrorFitted error_fitted(const Series& trace, const MachineErrorOptions& options) {
  // Without a stated feed nothing tells the size of what grows with it.
  Series stated_feed;
  const std::vector<double>& feed = values_of(trace, "feed");
  const bool lacks = std::any_of(feed.begin(), feed.end(), [](double value) { return !std::isfinite(value); });
  if (lacks) {
    stated_feed = trace;
    for (Column& column : stated_feed.columns) {
      if (column.name != trace_column("feed")) continue;
      for (double& value : column.values) value = std::isfinite(value) ? value : 0.0;
    }
  }
  return error_fitted(error_rows(lacks ? stated_feed : trace), options, set_up_of(trace));
}

std::vector<double> freed_of_centre(const ErrorFitted& fitted, const Series& trace) {
  // Its second order included; the radius stays.
  Eigen::VectorXd off = fitted.second_order_um;
  for (std::size_t k = 0; k < fitted.columns.columns.size(); ++k) {
    const auto column = static_cast<Eigen::Index>(k);
    const std::string& name = fitted.columns.columns[k].name;
    if (name == "centre_a" || name == "centre_b") off += fitted.gains[column] * fitted.columns.fine.col(column);
  }
  std::vector<double> freed = find_column(trace, "deviation_um")->values;
  for (std::size_t i = 0; i < freed.size(); ++i) freed[i] -= off[static_cast<Eigen::Index>(fitted.rows.fine_of[i])];
  return freed;
}

}  // namespace ballbar
