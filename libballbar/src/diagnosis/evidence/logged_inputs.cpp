#include "diagnosis/evidence/logged_inputs.hpp"

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

#include "ballbar/internal/numerics/interruption.hpp"
#include "ballbar/internal/numerics/order_statistic.hpp"
#include "ballbar/internal/numerics/range.hpp"
#include "ballbar/internal/series/signal_kind.hpp"
#include "ballbar/series/series.hpp"
#include "noise/linear_filter.hpp"
#include "series/equal_columns.hpp"
#include "series/equal_rows.hpp"
#include "series/resolution.hpp"
#include "series/saturated_rows.hpp"
#include "series/stuck_rows.hpp"

namespace ballbar {
namespace {

constexpr double kRest_s = 8.0 * 3600.0, kRestSteps = 10.0;  // of a machine that forgets its temperatures

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
// neighbours where the samples lie between rows; 1: none.
std::size_t ramped_rows(const std::vector<double>& values, const Tuning& tuning) {
  std::size_t best = 1;
  double most = tuning.bends;
  for (std::size_t rows = 3; rows <= tuning.longest_held && 4 * rows < values.size(); ++rows) {
    expect_no_interruption();
    std::vector<double> square(rows, 0.0);
    double all = 0.0;
    for (std::size_t i = 1; i + 1 < values.size(); ++i) {
      const double bend = values[i + 1] - 2.0 * values[i] + values[i - 1];
      square[i % rows] += bend * bend;
      all += bend * bend;
    }
    for (std::size_t k = 0; k < rows; ++k) {
      const double share = all > 0.0 ? (square[k] + square[(k + 1) % rows]) / all : 0.0;
      if (share > most) {
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

struct Observation {
  double time_s = 0.0, value = 0.0, variance = 1.0;  // in units of the scatter
};

// Integrated random walk x'' = white noise of this spectral density, seen at the observations. States (x, x'); it has
// no stationary variance, so that its gains are not those of a noise (linear_filter.hpp), its steps are.
struct Smoother {
  const std::vector<Observation>& observations;
  double density;

  static Eigen::Matrix2d transition(double dt) { return Eigen::Matrix2d{{1.0, dt}, {0.0, 1.0}}; }
  StateEstimate<2> moved(const StateEstimate<2>& from, double dt) const {
    const Eigen::Matrix2d added = density * Eigen::Matrix2d{{dt * dt * dt / 3.0, dt * dt / 2.0}, {dt * dt / 2.0, dt}};
    return predicted(from, transition(dt), added);
  }
  static StateUpdate<2> with(const StateEstimate<2>& before, const Observation& one) {
    return updated(before, {1.0, 0.0}, one.variance, one.value);
  }
  StateEstimate<2> start() const {
    const double span = observations.back().time_s - observations.front().time_s;
    const double slope = 1e6 / (span * span) + density * span;
    return {{observations.front().value, 0.0}, Eigen::Vector2d(1e6, slope).asDiagonal()};
  }
  // The most likely scatter; the first two observations determine the start of the curve.
  double log_likelihood() const {
    expect_no_interruption();
    double log_variances = 0.0, squares = 0.0;
    StateEstimate<2> now = start();
    for (std::size_t i = 0; i < observations.size(); ++i) {
      if (i > 0) now = moved(now, observations[i].time_s - observations[i - 1].time_s);
      const StateUpdate<2> update = with(now, observations[i]);
      now = update.after;
      if (i < 2) continue;
      log_variances += std::log(update.variance);
      squares += update.innovation * update.innovation / update.variance;
    }
    return -0.5 * log_variances -
           0.5 * static_cast<double>(observations.size() - 2) * std::log(std::max(squares, 1e-300));
  }
  // The smoothed curve at rising times: forwards, then Rauch, Tung and Striebel backwards.
  std::vector<double> at(const std::vector<double>& time_s) const {
    struct Step {
      double time_s;
      StateEstimate<2> before, after;
      std::optional<std::size_t> row;  // of time_s
    };
    expect_no_interruption();
    std::vector<Step> steps;
    steps.reserve(time_s.size() + observations.size());
    StateEstimate<2> now = start();
    double last = std::min(observations.front().time_s, time_s.front());
    std::size_t next = 0;
    for (std::size_t i = 0; i <= time_s.size(); ++i) {
      for (; next < observations.size() && (i == time_s.size() || observations[next].time_s <= time_s[i]); ++next) {
        const StateEstimate<2> before = moved(now, observations[next].time_s - last);
        now = with(before, observations[next]).after;
        last = observations[next].time_s;
        steps.push_back({last, before, now, std::nullopt});
      }
      if (i == time_s.size()) break;
      now = moved(now, time_s[i] - last);
      last = time_s[i];
      steps.push_back({last, now, now, i});
    }
    expect_no_interruption();
    std::vector<double> values(time_s.size());
    Eigen::Vector2d smooth = steps.back().after.x;
    for (std::size_t k = steps.size(); k-- > 0;) {
      const StateEstimate<2>& after = steps[k].after;
      const double dt = k + 1 < steps.size() ? steps[k + 1].time_s - steps[k].time_s : 0.0;
      if (dt > 0.0) {
        // x = after + P F' Q^-1 (smooth - before), P after this step, Q before the next
        const StateEstimate<2>& before = steps[k + 1].before;
        smooth = before.p.determinant() > 0.0
                     ? Eigen::Vector2d(after.x + after.p * transition(dt).transpose() *
                                                     (before.p.inverse() * (smooth - before.x)))
                     : after.x;
      }
      if (steps[k].row) values[*steps[k].row] = smooth[0];
    }
    return values;
  }
};

// The smooth curve through the observations, with the roughness by maximum likelihood.
std::vector<double> smoothed(const std::vector<Observation>& observations, const std::vector<double>& time_s) {
  double best = 0.0, most = -std::numeric_limits<double>::infinity();
  const double span = observations.back().time_s - observations.front().time_s;
  const double usual = std::max(span / static_cast<double>(observations.size() - 1), 1e-3);
  for (double step = 0.2 * usual; step < 0.3 * span; step *= 2.0) {
    // A walk that goes by as much as the scatter in this time.
    const double density = 3.0 / (step * step * step);
    const double now = Smoother{observations, density}.log_likelihood();
    if (now > most) {
      most = now;
      best = density;
    }
  }
  return Smoother{observations, best}.at(time_s);
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

// A smooth curve through the runs of a coarse column where it spends several rows each, else through its samples; those
// of rows that are read one by one are as they are.
std::vector<double> continuous_between_pauses(const std::vector<double>& time_s, const std::vector<double>& values,
                                              std::size_t held, bool is_read, const Tuning& tuning) {
  const std::vector<RowRange> runs = equal_rows(values);
  if (runs.size() < tuning.fewest_changes) return values;
  std::vector<Observation> observations;
  observations.reserve(runs.size());
  const bool coarse = 3 * runs.size() < values.size() / held && climbs_by_one(runs, values, tuning);
  if (is_read && !coarse) return values;
  if (coarse) {
    for (const RowRange& run : runs) {
      const bool is_short = run.end - run.begin < 3 * held;
      // A held value is that at the beginning of its run.
      const double late_s = held > 1 ? 0.5 * (time_s[1] - time_s[0]) * static_cast<double>(held - 1) : 0.0;
      observations.push_back(
          {0.5 * (time_s[run.begin] + time_s[run.end - 1]) - late_s, values[run.begin], is_short ? 4.0 : 1.0});
    }
  } else {
    for (std::size_t i = held > 1 ? runs[1].begin % held : 0; i < values.size(); i += held) {
      observations.push_back({time_s[i], values[i], 1.0});
    }
  }
  return smoothed(observations, time_s);
}

// That of each stretch between pauses.
std::vector<double> continuous(const std::vector<double>& time_s, const std::vector<double>& values, std::size_t held,
                               bool is_read, const Tuning& tuning) {
  std::vector<double> curve;
  curve.reserve(values.size());
  const auto part = [](const std::vector<double>& of, std::size_t begin, std::size_t end) {
    return std::vector<double>(of.begin() + static_cast<std::ptrdiff_t>(begin),
                               of.begin() + static_cast<std::ptrdiff_t>(end));
  };
  const double longest_s = std::max(kRest_s, kRestSteps * median_step_s(time_s));
  for (std::size_t begin = 0, end = 0; begin < values.size(); begin = end) {
    for (end = begin + 1; end < values.size() && time_s[end] - time_s[end - 1] < longest_s;) ++end;
    const std::vector<double> own =
        continuous_between_pauses(part(time_s, begin, end), part(values, begin, end), held, is_read, tuning);
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
        const std::vector<RowRange> runs = stuck_runs(column.values);
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
      if (tuning.smoothing && is_temperature(column))
        column.values = continuous(data.time_s, column.values, rows, is_read, tuning);
    } else {
      continue;
    }
    input.late_s = sample_s > step_s ? sample_s : std::min(step_s, tuning.longest_sample_s);
    result.inputs.push_back(std::move(input));
  }
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

// The variance of the readings about their curve; of a sensor without noise that of its rounding.
double variance_about(const std::vector<double>& curve, const std::vector<double>& read) {
  const auto count = static_cast<Eigen::Index>(read.size());
  const double resolution = resolution_of(read);
  return (Eigen::ArrayXd::Map(curve.data(), count) - Eigen::ArrayXd::Map(read.data(), count)).square().mean() +
         resolution * resolution / 12.0;
}

// The readings without those in which either sensor is saturated or stuck.
std::vector<double> read_by_both(const Series& data, const LoggedInput& input, const LoggedInput& other) {
  std::vector<double> values = find_column(data, input.column)->values;
  for (const LoggedInput* one : {&input, &other}) {
    for (const std::size_t row : one->at_end) values[row] = std::numeric_limits<double>::quiet_NaN();
  }
  return values;
}

// nullopt: they do not measure the same quantity.
std::optional<LinearRelation> relation_of(const Series& data, const LoggedInput& input, const LoggedInput& other) {
  expect_no_interruption();
  if (input.is_stepped != other.is_stepped || unit_of(input.column) != unit_of(other.column)) return std::nullopt;
  return equal_columns(read_by_both(data, input, other), read_by_both(data, other, input),
                       std::max(input.held, other.held));
}

// Columns that measure the same quantity; each of them equals each other one. Of curves the mean, each with the weight
// of its noise, replaces them.
void take_means(const Series& data, LoggedInputs& logged) {
  std::set<std::string> taken;
  for (std::size_t i = 0; i < logged.inputs.size(); ++i) {
    const LoggedInput& first = logged.inputs[i];
    if (taken.contains(first.column)) continue;
    std::vector<std::pair<const LoggedInput*, LinearRelation>> group{{&first, {}}};
    for (std::size_t k = i + 1; k < logged.inputs.size(); ++k) {
      const LoggedInput& other = logged.inputs[k];
      if (taken.contains(other.column)) continue;
      const auto relation = relation_of(data, first, other);
      if (!relation) continue;
      if (std::all_of(group.begin() + 1, group.end(),
                      [&](const auto& one) { return relation_of(data, *one.first, other).has_value(); }))
        group.emplace_back(&other, *relation);
    }
    if (group.size() == 1) continue;
    const auto curve_of = [&](const LoggedInput& input) -> std::vector<double>& {
      return std::find_if(logged.series.columns.begin(), logged.series.columns.end(),
                          [&](const Column& column) { return column.name == input.column; })
          ->values;
    };
    std::vector<double> mean(data.time_s.size(), 0.0);
    double weights = 0.0;
    for (const auto& [input, relation] : group) {
      const std::vector<double>& curve = curve_of(*input);
      const double scale = relation.slope * relation.slope;
      const double weight = scale / std::max(variance_about(curve, find_column(data, input->column)->values), 1e-12);
      weights += weight;
      for (std::size_t row = 0; row < mean.size(); ++row)
        mean[row] += weight * (curve[row] - relation.offset) / relation.slope;
      taken.insert(input->column);
      if (input != &first) logged.equal.push_back({first.column, input->column});
    }
    if (first.is_stepped) continue;  // the same steps, each with its own jumps
    for (const auto& [input, relation] : group) {
      std::vector<double>& curve = curve_of(*input);
      for (std::size_t row = 0; row < mean.size(); ++row)
        curve[row] = relation.offset + relation.slope * mean[row] / weights;
    }
  }
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
