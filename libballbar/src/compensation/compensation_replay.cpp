#include "ballbar/compensation/compensation_replay.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "ballbar/error.hpp"
#include "ballbar/nearest_name.hpp"
#include "numerics/not_finite.hpp"

namespace ballbar {
namespace {

// The latest value of a column of one of the signals.
struct Feed {
  const Series* series = nullptr;
  const std::vector<double>* values = nullptr;
  std::size_t next = 0;
  double latest = kUnknown, latest_s = kUnknown;

  double at(double time_s, double longest_s) {
    for (; next < series->time_s.size() && series->time_s[next] <= time_s; ++next) {
      latest = (*values)[next];
      latest_s = series->time_s[next];
    }
    return time_s - latest_s <= longest_s ? latest : kUnknown;
  }
};

Feed feed_of(const std::string& name, const std::vector<Series>& signals) {
  std::vector<std::string_view> known;
  for (const Series& series : signals) {
    if (const Column* column = find_column(series, name)) return {&series, &column->values};
    for (const Column& column : series.columns) known.push_back(column.name);
  }
  throw Error(fmt::format("expected the column {} among the signals, which the model reads, found none{}.", name,
                          known.empty() ? "" : fmt::format("; the nearest is {}", nearest_name(name, known))));
}

std::vector<double> times_of(const std::vector<Series>& signals) {
  std::vector<double> time_s;
  for (const Series& series : signals) time_s.insert(time_s.end(), series.time_s.begin(), series.time_s.end());
  std::sort(time_s.begin(), time_s.end());
  time_s.erase(std::unique(time_s.begin(), time_s.end()), time_s.end());
  return time_s;
}

// The values of the target from the first row of the signals on.
ReplayedAxis measured_axis(const CompensatedAxis& axis, const Series& measured, double from_s) {
  ReplayedAxis replayed{axis.name, axis.model.targets.front()};
  const Column* column = find_column(measured, replayed.target);
  if (column == nullptr) {
    throw Error(fmt::format("{}: expected the measured column {}, found none.", axis.name, replayed.target));
  }
  for (std::size_t i = 0; i < measured.time_s.size(); ++i) {
    if (measured.time_s[i] < from_s || !std::isfinite(column->values[i])) continue;
    replayed.time_s.push_back(measured.time_s[i]);
    replayed.before_um.push_back(column->values[i]);
  }
  if (replayed.time_s.size() < 2) {
    throw Error(fmt::format("{}: expected at least two values of {} after the first row of the signals, found {}.",
                            axis.name, replayed.target, replayed.time_s.size()));
  }
  const double zero_um = replayed.before_um.front();
  for (double& before_um : replayed.before_um) before_um -= zero_um;
  return replayed;
}

}  // namespace

Replay replay_of(const std::vector<CompensatedAxis>& axes, const CompensationLimits& limits,
                 const std::vector<Series>& signals, const Series& measured) {
  CompensatedAxes machine(axes, limits);
  std::vector<Feed> feeds;
  for (const std::string& column : machine.columns()) feeds.push_back(feed_of(column, signals));
  const std::vector<double> time_s = times_of(signals);
  Replay replay{time_s.size(), {}};
  if (time_s.empty()) throw Error("expected signals with rows, found none.");
  for (const CompensatedAxis& axis : axes) replay.axes.push_back(measured_axis(axis, measured, time_s.front()));
  // The offsets in force before a row are those of the row before it.
  std::vector<double> offset_um(axes.size(), 0.0), values(feeds.size());
  const auto meet = [&](double until_s) {
    for (std::size_t a = 0; a < axes.size(); ++a) {
      ReplayedAxis& axis = replay.axes[a];
      while (axis.offset_um.size() < axis.time_s.size() && axis.time_s[axis.offset_um.size()] <= until_s) {
        axis.offset_um.push_back(offset_um[a]);
      }
    }
  };
  std::vector<std::vector<std::size_t>> held_by;  // of each axis, by its columns
  for (std::size_t a = 0; a < axes.size(); ++a) held_by.emplace_back(machine.axis(a).columns().size());
  for (const double row_s : time_s) {
    meet(row_s);
    for (std::size_t c = 0; c < feeds.size(); ++c) values[c] = feeds[c].at(row_s, limits.gap_s);
    const std::span<const Offset> offsets = machine.next(row_s, values);
    for (std::size_t a = 0; a < axes.size(); ++a) {
      offset_um[a] = offsets[a].offset_um;
      ++replay.axes[a].rows_held[static_cast<std::size_t>(offsets[a].hold)];
      if (is_about_a_column(offsets[a].hold)) ++held_by[a][offsets[a].column];
      replay.axes[a].rows_limited += offsets[a].limited ? 1 : 0;
    }
  }
  meet(std::numeric_limits<double>::infinity());
  for (std::size_t a = 0; a < axes.size(); ++a) {
    const auto most = std::max_element(held_by[a].begin(), held_by[a].end());
    if (most == held_by[a].end() || *most == 0) continue;
    replay.axes[a].most_held_by = machine.axis(a).columns()[static_cast<std::size_t>(most - held_by[a].begin())];
  }
  for (ReplayedAxis& axis : replay.axes) {
    for (std::size_t i = 0; i < axis.time_s.size(); ++i) {
      axis.after_um.push_back(axis.before_um[i] + axis.offset_um[i] - axis.offset_um.front());
    }
    axis.reduction = reduction_of(std::span(axis.before_um).subspan(1), std::span(axis.after_um).subspan(1),
                                  ErrorSize::root_mean_square);
  }
  return replay;
}

}  // namespace ballbar
