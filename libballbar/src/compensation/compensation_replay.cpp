#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <vector>

#include "ballbar/compensation/compensation.hpp"
#include "ballbar/error.hpp"
#include "ballbar/internal/nearest_name.hpp"
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

double sum_of(std::span<const double> errors_um, ErrorSize size) {
  double sum = 0.0;
  for (const double error_um : errors_um)
    sum += size == ErrorSize::mean_of_sizes ? std::abs(error_um) : error_um * error_um;
  return sum;
}

double share_of(double before, double after, ErrorSize size) {
  if (!(before > 0.0)) return kUnknown;
  return 1.0 - (size == ErrorSize::mean_of_sizes ? after / before : std::sqrt(after / before));
}

// Twice the lag at which the autocorrelation of the values has decayed.
std::size_t stretch_of(std::span<const double> values) {
  const std::size_t n = values.size(), longest = std::max<std::size_t>(1, n / 5);
  double mean = 0.0, square = 0.0;
  for (const double value : values) mean += value / static_cast<double>(n);
  for (const double value : values) square += (value - mean) * (value - mean);
  for (std::size_t lag = 1; lag < longest; ++lag) {
    double product = 0.0;
    for (std::size_t i = lag; i < n; ++i) product += (values[i] - mean) * (values[i - lag] - mean);
    if (!(product > 0.2 * square)) return std::min(longest, lag == 1 ? lag : 2 * lag);
  }
  return longest;
}

// sigma^2 = (g - 1) / g sum (share without stretch j - their mean)^2, g stretches
double jackknife(std::span<const double> before_um, std::span<const double> after_um, ErrorSize size,
                 std::size_t stretch) {
  const std::size_t n = before_um.size();
  if (n < 3) return kUnknown;
  const double before = sum_of(before_um, size), after = sum_of(after_um, size);
  std::vector<double> without;
  double mean = 0.0;
  for (std::size_t from = 0; from < n; from += stretch) {
    const std::size_t count = std::min(stretch, n - from);
    without.push_back(share_of(before - sum_of(before_um.subspan(from, count), size),
                               after - sum_of(after_um.subspan(from, count), size), size));
    mean += without.back();
  }
  const auto groups = static_cast<double>(without.size());
  mean /= groups;
  double square = 0.0;
  for (const double share : without) square += (share - mean) * (share - mean);
  return std::sqrt((groups - 1.0) / groups * square);
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

Reduction reduction_of(std::span<const double> before_um, std::span<const double> after_um, ErrorSize size) {
  assert(!before_um.empty() && before_um.size() == after_um.size());
  const auto n = static_cast<double>(before_um.size());
  const double before = sum_of(before_um, size), after = sum_of(after_um, size);
  const bool squares = size == ErrorSize::root_mean_square;
  const std::size_t stretch = stretch_of(after_um);
  return {squares ? std::sqrt(before / n) : before / n, squares ? std::sqrt(after / n) : after / n,
          share_of(before, after, size), jackknife(before_um, after_um, size, stretch), stretch};
}

}  // namespace ballbar
