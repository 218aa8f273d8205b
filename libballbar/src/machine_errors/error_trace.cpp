// The errors of a machine from the trace of its recordings.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ballbar/circle/trace.hpp"
#include "ballbar/error.hpp"
#include "ballbar/units.hpp"
#include "machine_errors/error_fit.hpp"

namespace ballbar {
namespace {

constexpr double kFeedOfOneMs_mm_per_min = 60.0;  // a delay of 1 ms is 1 um

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
  double cos = 0.0, sin = 0.0;
  for (const double angle : angle_rad) cos += std::cos(angle), sin += std::sin(angle);
  set_up.arc_rad = longest_arc_rad(trace);
  set_up.middle_rad = std::atan2(sin, cos);
  set_up.length_mm = values_of(trace, "radius").front();
  set_up.height_mm = values_of(trace, "height").front();
  set_up.pitch_a_mm = stated(values_of(trace, "pitch_a").front());
  set_up.pitch_b_mm = stated(values_of(trace, "pitch_b").front());
  return set_up;
}

// Deviation of the readings freed of the fitted centre.
std::vector<double> freed_of_centre(const JointErrorFit& fitted, const Series& trace) {
  // Centre of all, and what each recording has beside it; the radius stays, and how CCW and CW differ.
  const std::vector<double>& recording = values_of(trace, "recording");
  const std::vector<double>& angle_rad = values_of(trace, "angle");
  std::vector<double> a_um(fitted.rows.recordings, 0.0), b_um = a_um;
  for (std::size_t k = 0; k < fitted.columns.columns.size(); ++k) {
    const ErrorColumn& column = fitted.columns.columns[k];
    if (column.effect != nullptr) break;
    if (!is_centre(column)) continue;
    std::vector<double>& centre_um = column.name.starts_with("centre_a") ? a_um : b_um;
    for (std::size_t one = 0; one < centre_um.size(); ++one) {
      if (column.recording.value_or(one) == one) centre_um[one] += fitted.curve_gains[static_cast<Eigen::Index>(k)];
    }
  }
  std::vector<double> freed = find_column(trace, "deviation_um")->values;
  for (std::size_t i = 0; i < freed.size(); ++i) {
    const auto of = static_cast<std::size_t>(recording[i]);
    freed[i] -= a_um[of] * std::cos(angle_rad[i]) + b_um[of] * std::sin(angle_rad[i]) +
                fitted.second_order_um[static_cast<Eigen::Index>(fitted.rows.fine_of[i])];
  }
  return freed;
}

// What the fit leaves of readings beyond what it leaves of their rows.
double within_rows_um2(const JointErrorFit& fitted) {
  Eigen::VectorXd rest = Eigen::VectorXd::Zero(fitted.columns.fine.rows());
  const std::vector<bool> in = fitted.in_the_fit();
  for (std::size_t k = 0; k < in.size(); ++k) {
    if (in[k] && !is_centre(fitted.columns.columns[k])) {
      rest += fitted.curve_gains[static_cast<Eigen::Index>(k)] * fitted.columns.fine.col(static_cast<Eigen::Index>(k));
    }
  }
  double squares = 0.0;
  for (std::size_t i = 0; i < fitted.freed_um.size(); ++i) {
    const double left = fitted.freed_um[i] - rest[static_cast<Eigen::Index>(fitted.rows.fine_of[i])];
    squares += left * left;
  }
  return std::max(0.0, (squares - fitted.residual().cwiseAbs2().dot(fitted.rows.count)) / fitted.rows.count.sum());
}

bool states_feed(const Series& trace) {
  const std::vector<double>& feed = values_of(trace, "feed");
  return std::any_of(feed.begin(), feed.end(), [](double value) { return std::isfinite(value); });
}

bool grows_with_feed(const Effect& effect) {
  return std::any_of(effect.inputs.begin(), effect.inputs.end(),
                     [](const Input& input) { return input.role == "feed"; });
}

}  // namespace

bool is_centre(const ErrorColumn& column) {
  return column.effect == nullptr && (column.name.starts_with("centre_a") || column.name.starts_with("centre_b"));
}

double longest_arc_rad(const Series& trace) {
  const std::vector<double>& angle_rad = values_of(trace, "angle");
  const std::vector<double>& recording = values_of(trace, "recording");
  double longest = 0.0;
  for (std::size_t first = 0; first < angle_rad.size();) {
    std::size_t last = first;
    while (last < angle_rad.size() && recording[last] == recording[first]) ++last;
    longest = std::max(longest, arc_of(std::span(angle_rad).subspan(first, last - first)));
    first = last;
  }
  return longest;
}

Series with_feed(Series trace) {
  const double unknown_mm_per_min = states_feed(trace) ? 0.0 : kFeedOfOneMs_mm_per_min;
  for (Column& column : trace.columns) {
    if (column.name != trace_column("feed")) continue;
    for (double& value : column.values) value = std::isfinite(value) ? value : unknown_mm_per_min;
  }
  return trace;
}

JointErrorFit joint_error_fit(const Series& trace, const MachineErrorOptions& options) {
  const ErrorSetUp set_up = set_up_of(trace);
  if (set_up.arc_rad < kShortestArc_rad) {
    throw Error(
        fmt::format("an arc of {:.0f} deg is too short for the errors of the axes: expected at least {:.0f} deg, below "
                    "which they look alike. ballbar fit gives the circle.",
                    deg_from_rad(set_up.arc_rad), deg_from_rad(kShortestArc_rad)));
  }
  const ErrorRows rows = error_rows(with_feed(trace));
  JointErrorFit fitted = joint_error_fit(rows, options, set_up);
  if (!states_feed(trace)) {
    for (ErrorColumn& column : fitted.columns.columns) {
      if (column.effect != nullptr && grows_with_feed(*column.effect)) column.unit = "um";
    }
  }
  fitted.freed_um = freed_of_centre(fitted, trace);
  fitted.within_um2 = within_rows_um2(fitted);
  return fitted;
}

}  // namespace ballbar
