#include "diagnosis/evidence/logged_inputs.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

#include "ballbar/internal/numerics/interruption.hpp"
#include "ballbar/internal/numerics/order_statistic.hpp"
#include "ballbar/internal/numerics/range.hpp"
#include "ballbar/internal/series/signal_kind.hpp"
#include "ballbar/series/series.hpp"
#include "diagnosis/evidence/equal_inputs.hpp"
#include "diagnosis/evidence/smooth_curve.hpp"
#include "series/equal_rows.hpp"
#include "series/pause.hpp"
#include "series/resolution.hpp"
#include "series/saturated_rows.hpp"
#include "series/stuck_rows.hpp"

namespace ballbar {
namespace {

bool is_whole(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
}

// Rows for which a logger holds a value: all changes are so many rows apart or a multiple of it; 1: it does not.
// nullopt: the column changes too seldom to tell.
std::optional<std::size_t> held_rows(const std::vector<double>& values, const Tuning& tuning) {
  std::vector<std::size_t> changes;
  for (std::size_t i = 1; i < values.size(); ++i) {
    if (values[i] != values[i - 1]) changes.push_back(i);
  }
  if (changes.size() < tuning.fewest_changes) return std::nullopt;
  std::size_t common = 0;
  for (std::size_t k = 1; k < changes.size() && common != 1; ++k)
    common = std::gcd(common, changes[k] - changes[k - 1]);
  return common;
}

// Rows between the samples of which a column is the straight lines: it bends at one row of so many, or at two
// neighbours where the samples lie between rows, and elsewhere by no more than its rounding; 1: none. What bends at
// full hours alone, as where the speed changes, has its noise elsewhere.
std::size_t ramped_rows(const std::vector<double>& values, const Tuning& tuning) {
  const double rounding = std::max(2.01 * resolution_of(values), 1e-6 * range_of(values));
  std::size_t best = 1;
  double most = tuning.bends;
  for (std::size_t rows = 3; rows <= tuning.longest_held && 4 * rows < values.size(); ++rows) {
    expect_no_interruption();
    std::vector<double> square(rows, 0.0);
    std::vector<std::size_t> plain(rows, 0);  // bends beyond the rounding
    for (std::size_t i = 1; i + 1 < values.size(); ++i) {
      const double bend = values[i + 1] - 2.0 * values[i] + values[i - 1];
      square[i % rows] += bend * bend;
      plain[i % rows] += std::abs(bend) > rounding ? 1 : 0;
    }
    const double all = std::accumulate(square.begin(), square.end(), 0.0);
    const std::size_t all_plain = std::accumulate(plain.begin(), plain.end(), std::size_t{0});
    for (std::size_t k = 0; k < rows; ++k) {
      const std::size_t next = (k + 1) % rows;
      const double share = all > 0.0 ? (square[k] + square[next]) / all : 0.0;
      const std::size_t elsewhere = all_plain - plain[k] - plain[next];
      if (share > most && static_cast<double>(elsewhere) <= (1.0 - tuning.bends) * static_cast<double>(all_plain)) {
        most = share;
        best = rows;
      }
    }
  }
  return best;
}

// Whether all steps between rows are equal.
bool is_even(const std::vector<double>& time_s) {
  const double step = median_step_s(time_s);
  for (std::size_t i = 1; i < time_s.size(); ++i) {
    if (std::abs(time_s[i] - time_s[i - 1] - step) > 0.01 * step) return false;
  }
  return true;
}

// Changes of more than a share of the range; adjacent ones are joined up to the length of a ramp.
std::vector<Jump> jumps_of(const std::vector<double>& time_s, const std::vector<double>& values, std::size_t held,
                           double longest_s, const Tuning& tuning) {
  const double least = tuning.jump * range_of(values);
  std::vector<Jump> jumps;
  for (std::size_t i = 1; i < values.size(); ++i) {
    if (!(std::abs(values[i] - values[i - 1]) > least)) continue;
    std::size_t end = i;
    const bool up = values[i] > values[i - 1];
    while (end + 1 < values.size() && (values[end + 1] > values[end]) == up &&
           std::abs(values[end + 1] - values[end]) > least && time_s[end + 1] - time_s[i - 1] <= longest_s) {
      ++end;
    }
    Jump jump{i - 1, end, values[i - 1], values[end]};
    if (end == i && held > 1) jump.first = i >= held ? i - held : 0;
    if (!jumps.empty() && jump.first < jumps.back().last) jump.first = jumps.back().last;
    if (jump.first < jump.last) jumps.push_back(jump);
    i = end;
  }
  return jumps;
}

// Whether the column is mostly constant, so that a few large changes describe it.
bool changes_in_jumps(const std::vector<double>& values, const std::vector<Jump>& jumps) {
  if (jumps.empty()) return false;
  double all = 0.0, in_jumps = 0.0;
  std::size_t rows = 0;
  for (std::size_t i = 1; i < values.size(); ++i) all += std::abs(values[i] - values[i - 1]);
  for (const Jump& jump : jumps) {
    in_jumps += std::abs(jump.after - jump.before);
    rows += jump.last - jump.first;
  }
  return in_jumps > 0.5 * all && 2 * rows < values.size();
}

// The old value up to the middle of the interval of the change, then the new one; the step is half way between two
// rows.
void draw_step(std::vector<double>& values, const Jump& jump) {
  for (std::size_t row = jump.first + 1; row < jump.last; ++row) {
    const std::size_t twice = 2 * row, middle = jump.first + jump.last;
    values[row] = twice < middle ? jump.before : twice > middle ? jump.after : 0.5 * (jump.before + jump.after);
  }
}

// The straight line from the value before these rows to that behind them; at an end the value on the other side.
void draw_line(std::vector<double>& values, const RowRange& rows) {
  const double before = rows.begin > 0 ? values[rows.begin - 1] : values[rows.end];
  const double behind = rows.end < values.size() ? values[rows.end] : before;
  const double slope = (behind - before) / static_cast<double>(rows.end - rows.begin + 1);
  for (std::size_t row = rows.begin; row < rows.end; ++row)
    values[row] = before + slope * static_cast<double>(row - rows.begin + 1);
}

// Whether successive runs of equal values differ by one resolution: the sampling of something smooth.
bool climbs_by_one(const std::vector<RowRange>& runs, const std::vector<double>& values, const Tuning& tuning) {
  const double resolution = resolution_of(values);
  std::size_t by_one = 0;
  for (std::size_t k = 1; k < runs.size(); ++k)
    by_one += std::abs(values[runs[k].begin] - values[runs[k - 1].begin]) < 1.5 * resolution ? 1 : 0;
  return resolution > 0.0 && static_cast<double>(by_one) > tuning.climbs * static_cast<double>(runs.size() - 1);
}

// What a coarse column says of its curve: half way between two runs it has their mean, and within a long run it is
// near its value.
std::vector<Observation> observations_of_runs(const std::vector<double>& time_s, const std::vector<double>& values,
                                              const std::vector<RowRange>& runs, std::size_t held) {
  constexpr std::size_t kUsualRuns = 3;                            // as far apart are values within a run
  constexpr double kWithin = 4.0, kBetween = 1.0, kFarther = 4.0;  // variances; of runs farther apart than a resolution
  const double resolution = resolution_of(values);
  std::vector<std::size_t> samples;
  samples.reserve(runs.size());
  for (const RowRange& run : runs) samples.push_back((run.end - run.begin) / held);
  const std::size_t apart = kUsualRuns * held * std::max<std::size_t>(1, median(samples));
  std::vector<Observation> observations;
  observations.reserve(2 * runs.size());
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const std::size_t begin = runs[k].begin, rows = runs[k].end - begin, within = rows / apart;
    if (k > 0) {
      const double step = std::abs(values[begin] - values[begin - 1]);
      observations.push_back({0.5 * (time_s[begin - held] + time_s[begin]), 0.5 * (values[begin - 1] + values[begin]),
                              step < 1.5 * resolution ? kBetween : kFarther});
    }
    for (std::size_t j = 0; j < within; ++j) {
      const std::size_t row = begin + (2 * j + 1) * rows / (2 * within) / held * held;
      observations.push_back({time_s[row], values[begin], kWithin});
    }
  }
  return observations;
}

// A smooth curve through the runs of a coarse column where it spends several rows each, else through its samples; those
// of rows that are read one by one are as they are.
std::vector<double> continuous_between_pauses(const std::vector<double>& time_s, const std::vector<double>& values,
                                              std::size_t held, bool is_read, const std::vector<double>& bends_s,
                                              const Tuning& tuning) {
  const std::vector<RowRange> runs = equal_rows(values);
  if (runs.size() < tuning.fewest_changes) return values;
  if (3 * runs.size() < values.size() / held && climbs_by_one(runs, values, tuning))
    return smooth_curve(observations_of_runs(time_s, values, runs, held), time_s, bends_s);
  if (is_read) return values;
  std::vector<Observation> observations;
  for (std::size_t i = held > 1 ? runs[1].begin % held : 0; i < values.size(); i += held)
    observations.push_back({time_s[i], values[i], 1.0});
  return tuning.outliers_of_inputs ? robust_curve(std::move(observations), time_s, bends_s, tuning)
                                   : smooth_curve(observations, time_s, bends_s);
}

// That of each stretch between pauses.
std::vector<double> continuous(const std::vector<double>& time_s, const std::vector<double>& values, std::size_t held,
                               bool is_read, const std::vector<double>& bends_s, const Tuning& tuning) {
  std::vector<double> curve;
  curve.reserve(values.size());
  const auto part = [](const std::vector<double>& of, std::size_t begin, std::size_t end) {
    return std::vector<double>(of.begin() + static_cast<std::ptrdiff_t>(begin),
                               of.begin() + static_cast<std::ptrdiff_t>(end));
  };
  for (const auto& [begin, end] : between_pauses(time_s)) {
    const std::vector<double> own =
        continuous_between_pauses(part(time_s, begin, end), part(values, begin, end), held, is_read, bends_s, tuning);
    curve.insert(curve.end(), own.begin(), own.end());
  }
  return curve;
}

bool is_temperature(const Column& column) {
  const std::string_view unit = unit_of(column.name);
  return unit == "degC" || unit == "K";
}

// A temperature that a logger holds for some rows changes in steps as well, but hardly comes back to a level.
bool is_switched(const Column& column, SignalKind kind, const Tuning& tuning) {
  if (kind != SignalKind::steps || column.role == Role::measured) return false;
  if (!is_temperature(column)) return true;
  return std::set<double>(column.values.begin(), column.values.end()).size() <= tuning.levels_of_switch;
}

// Where the column is mostly constant it is stepped by these jumps.
void draw_steps(std::vector<Jump> jumps, LoggedInput& input, std::vector<double>& values, const Tuning& tuning) {
  input.is_stepped = changes_in_jumps(values, jumps);
  if (!input.is_stepped) return;
  for (const Jump& jump : jumps) {
    if (tuning.steps_within_samples) draw_step(values, jump);
  }
  input.jumps = std::move(jumps);
}

// When the stepped inputs change: in the middle of the rows between, and at the later one, for a thermometer may be
// read before the speed.
std::vector<double> moments_of_jumps(const std::vector<LoggedInput>& inputs, const std::vector<double>& time_s) {
  std::vector<double> moments;
  for (const LoggedInput& input : inputs) {
    for (const Jump& jump : input.jumps) {
      moments.push_back(0.5 * (time_s[jump.first] + time_s[jump.last]));
      moments.push_back(time_s[jump.last]);
    }
  }
  std::sort(moments.begin(), moments.end());
  return moments;
}

LoggedInputs inputs_of_run(const Series& data, const std::vector<std::string>& targets, const Tuning& tuning) {
  LoggedInputs result;
  result.series = data;
  if (data.time_s.size() < tuning.fewest_changes || find_column(data, "angle_rad") != nullptr) return result;
  const double step_s = median_step_s(data.time_s);
  const bool even = is_even(data.time_s);
  // A logger asks all its inputs alike: what the temperatures show holds for the speed, whose programme may itself
  // change on whole minutes.
  std::size_t held = 0, ramped = 0;
  for (const Column& column : data.columns) {
    if (!is_temperature(column) || !is_whole(column.values) || !even) continue;
    const std::optional<std::size_t> rows = held_rows(column.values, tuning);
    if (!rows) continue;
    if (held == 0 || *rows < held) held = *rows;
    const std::size_t lines = *rows > 1 ? 1 : ramped_rows(column.values, tuning);
    ramped = std::max(ramped, lines);
  }
  held = std::max<std::size_t>(1, held);
  ramped = std::max<std::size_t>(1, ramped);
  struct RoughColumn {
    Column* column;
    std::size_t held;
    bool is_read;
  };
  std::vector<RoughColumn> rough;
  for (Column& column : result.series.columns) {
    if (std::find(targets.begin(), targets.end(), column.name) != targets.end()) continue;
    if (!is_whole(column.values) || !(range_of(column.values) > 0.0)) continue;
    LoggedInput input;
    input.column = column.name;
    double sample_s = step_s;
    if (column.role == Role::speed || column.role == Role::load) {
      const std::size_t own = even ? held_rows(column.values, tuning).value_or(1) : 1;
      const std::size_t rows = held > 1 || ramped > 1
                                   ? std::max(held, ramped)
                                   : (static_cast<double>(own) * step_s <= tuning.longest_sample_s ? own : 1);
      const double longest_s = std::max(tuning.longest_ramp_s, 1.5 * static_cast<double>(rows) * step_s);
      sample_s = static_cast<double>(rows) * step_s;
      draw_steps(jumps_of(data.time_s, column.values, ramped > 1 ? 1 : rows, longest_s, tuning), input, column.values,
                 tuning);
    } else if (const SignalKind kind = signal_kind(column.values); is_switched(column, kind, tuning)) {
      draw_steps(jumps_of(data.time_s, column.values, 1, tuning.longest_ramp_s, tuning), input, column.values, tuning);
    } else if (is_temperature(column) || (kind == SignalKind::smooth && column.role != Role::measured)) {
      input.at_end = saturated_rows(
          column.values, {tuning.fewest_at_end, tuning.least_at_end, tuning.small_step, tuning.fewest_changes});
      if (tuning.stuck_sensors && input.at_end.empty()) {
        const std::vector<RowRange> runs = stuck_runs(column.values, is_temperature(column));
        for (const RowRange& run : runs) {
          input.is_stuck = true;
          for (std::size_t row = run.begin; row < run.end; ++row) input.at_end.push_back(row);
        }
        for (const RowRange& run : runs) draw_line(column.values, run);
      }
      const std::size_t rows = even ? held_rows(column.values, tuning).value_or(1) : 1;
      input.held = rows;
      const std::size_t sample = std::max(rows, even ? ramped_rows(column.values, tuning) : 1);
      sample_s = static_cast<double>(sample) * step_s;
      // Rows far apart are read one by one, each within a short time.
      const bool is_read = sample == 1 && step_s > tuning.longest_sample_s;
      if (tuning.smoothing && is_temperature(column)) rough.push_back({&column, rows, is_read});
    } else {
      continue;
    }
    input.late_s = sample_s > step_s ? sample_s : std::min(step_s, tuning.longest_sample_s);
    result.inputs.push_back(std::move(input));
  }
  const std::vector<double> bends_s = moments_of_jumps(result.inputs, data.time_s);
  for (const RoughColumn& one : rough)
    one.column->values = continuous(data.time_s, one.column->values, one.held, one.is_read, bends_s, tuning);
  return result;
}

LoggedInputs inputs_of_runs(const Series& data, const std::vector<std::string>& targets, const Tuning& tuning) {
  const std::vector<RowRange> runs = runs_of(data.time_s);
  if (runs.size() < 2 || find_column(data, "angle_rad") != nullptr) return inputs_of_run(data, targets, tuning);
  // Each run has a logger of its own; what is stepped in one is so in all.
  LoggedInputs result;
  result.series = data;
  for (const RowRange& run : runs) {
    LoggedInputs own = inputs_of_run(rows_of(data, run), targets, tuning);
    for (std::size_t k = 0; k < data.columns.size(); ++k) {
      std::copy(own.series.columns[k].values.begin(), own.series.columns[k].values.end(),
                result.series.columns[k].values.begin() + static_cast<std::ptrdiff_t>(run.begin));
    }
    for (LoggedInput& input : own.inputs) {
      for (Jump& jump : input.jumps) {
        jump.first += run.begin;
        jump.last += run.begin;
      }
      for (std::size_t& row : input.at_end) row += run.begin;
      const auto known = std::find_if(result.inputs.begin(), result.inputs.end(),
                                      [&](const LoggedInput& one) { return one.column == input.column; });
      if (known == result.inputs.end()) {
        result.inputs.push_back(std::move(input));
        continue;
      }
      known->is_stepped = known->is_stepped || input.is_stepped;
      known->held = std::max(known->held, input.held);
      known->late_s = std::max(known->late_s, input.late_s);
      known->jumps.insert(known->jumps.end(), input.jumps.begin(), input.jumps.end());
      known->is_stuck = known->is_stuck || input.is_stuck;
      known->at_end.insert(known->at_end.end(), input.at_end.begin(), input.at_end.end());
    }
  }
  return result;
}

}  // namespace

std::vector<double> with_jump_moved(const std::vector<double>& values, const Jump& jump, bool earlier) {
  std::vector<double> moved = values;
  for (std::size_t row = jump.first + (earlier ? 0 : 1); row < jump.last + (earlier ? 0 : 1); ++row) {
    moved[row] = earlier ? jump.after : jump.before;
  }
  return moved;
}

LoggedInputs logged_inputs(const Series& data, const std::vector<std::string>& targets, const Tuning& tuning) {
  LoggedInputs result = inputs_of_runs(data, targets, tuning);
  if (tuning.equal_columns) take_means(data, result);
  return result;
}

}  // namespace ballbar
