#include "ballbar/drift/thermal_test.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numeric>
#include <optional>
#include <utility>

#include "ballbar/internal/numerics/order_statistic.hpp"
#include "ballbar/internal/series/speed_steps.hpp"
#include "ballbar/units.hpp"
#include "drift/name_words.hpp"
#include "drift/smooth_curve.hpp"
#include "numerics/not_finite.hpp"

namespace ballbar {
namespace {

constexpr const char* kRotaryAxes[] = {"a", "b", "c"};
constexpr double kDay_s = 23.5 * 3600.0, kShortRest_s = 600.0, kShortest_s = 60.0;
constexpr double kAtRest = 1.0;         // rpm, mm/min, deg/min
constexpr double kSameSpeed = 0.02;     // of the largest
constexpr double kLongestPause = 10.0;  // without a row, of a log that goes on
constexpr const char* kFeeds[] = {"mm_per_min", "deg_per_min"};
constexpr double kLeastShare = 0.05;  // of the time at speed
constexpr std::size_t kMostSpeeds = 20;

std::string shown_name(const Column& column) { return column.header.empty() ? column.name : column.header; }

// How an axis or the spindle moved. Rows without a value do not count; the last one before `from_s` holds until there.
struct AxisMotion {
  const Column* column = nullptr;  // nullptr: no column, or no value within
  double running_s = 0.0, rest_after_s = 0.0;
  std::vector<std::pair<double, double>> levels;  // speed, s
};

AxisMotion motion_in(const Series& series, const Column& column, double from_s, double to_s) {
  AxisMotion motion;
  std::vector<double> time_s;
  Column speed{column.name, column.role, {}};
  for (std::size_t row = 0; row < series.time_s.size() && series.time_s[row] <= to_s; ++row) {
    if (!std::isfinite(column.values[row])) continue;
    if (series.time_s[row] <= from_s) time_s.clear(), speed.values.clear();
    time_s.push_back(std::max(series.time_s[row], from_s));
    speed.values.push_back(std::abs(column.values[row]));
  }
  if (time_s.empty()) return motion;
  motion.column = &column;
  const double largest = *std::max_element(speed.values.begin(), speed.values.end());
  // Rows that are as dense as these end where the log does.
  const double step_s = time_s.size() > 1 ? median_step_s(time_s) : 0.0;
  const double end_s = step_s > 0.0 && to_s - time_s.back() > kLongestPause * step_s ? time_s.back() : to_s;
  const std::vector<SpeedStep> steps = speed_steps(time_s, speed);
  for (std::size_t k = 0; k < steps.size(); ++k) {
    const double size = steps[k].speed_rpm;
    const double lasts_s = (k + 1 < steps.size() ? time_s[steps[k + 1].begin] : end_s) - time_s[steps[k].begin];
    if (size <= kAtRest) {
      motion.rest_after_s += lasts_s;
      continue;
    }
    motion.rest_after_s = 0.0;
    motion.running_s += lasts_s;
    const auto level = std::find_if(motion.levels.begin(), motion.levels.end(), [&](const auto& one) {
      return std::abs(one.first - size) <= kSameSpeed * largest;
    });
    if (level != motion.levels.end()) {
      level->second += lasts_s;
    } else {
      motion.levels.emplace_back(size, lasts_s);
    }
  }
  return motion;
}

std::vector<TemperatureSpan> temperatures_of(std::span<const Series> signals, double from_s, double to_s) {
  std::vector<TemperatureSpan> spans;
  for (const Series& series : signals) {
    for (const Column& column : series.columns) {
      if (unit_of(column.name) != "degC") continue;
      TemperatureSpan span{shown_name(column), column.role, kUnknown, 0.0, 0.0};
      for (std::size_t row = 0; row < series.time_s.size(); ++row) {
        const double value = column.values[row];
        if (!std::isfinite(value) || series.time_s[row] < from_s || series.time_s[row] > to_s) continue;
        if (std::isnan(span.first_degC)) span.first_degC = span.least_degC = span.largest_degC = value;
        span.least_degC = std::min(span.least_degC, value);
        span.largest_degC = std::max(span.largest_degC, value);
      }
      if (std::isfinite(span.first_degC)) spans.push_back(std::move(span));
    }
  }
  std::stable_partition(spans.begin(), spans.end(), [](const auto& span) { return span.role == Role::ambient; });
  return spans;
}

std::vector<TestLack> lacks_of(const ThermalTest& test) {
  std::vector<TestLack> lacks;
  const auto lack = [&](bool is_lacking, TestLack one) {
    if (is_lacking) lacks.push_back(one);
  };
  const auto any = [&](bool of_room) {
    return std::any_of(test.temperatures.begin(), test.temperatures.end(),
                       [&](const TemperatureSpan& span) { return (span.role == Role::ambient) == of_room; });
  };
  const bool is_at_rest = test.kind == ThermalTestKind::environment;
  const bool of_spindle = test.kind == ThermalTestKind::spindle || test.kind == ThermalTestKind::spindle_spectrum;
  lack(test.kind == ThermalTestKind::unknown, TestLack::speed);
  lack(!any(true), TestLack::room_temperature);
  lack(!any(false) && !is_at_rest, TestLack::structure_temperature);
  lack(is_at_rest && test.duration_s < kDay_s, TestLack::a_day);
  lack(of_spindle && test.rest_after_s < kShortRest_s, TestLack::rest_after);
  return lacks;
}

const DriftAxis* axis_along(const MeasuredDrift& drift, char letter) {
  if (const DriftAxis* axis = find_axis(drift, std::string(1, letter))) return axis;
  const DriftAxis* found = nullptr;
  for (const DriftAxis& axis : drift.axes) {
    const std::string word(1, letter);
    if (!has_word(axis.name, word) && !has_word(axis.name, 'd' + word)) continue;
    if (found != nullptr) return nullptr;
    found = &axis;
  }
  return found;
}

// Drift since the reference at these rows, or where there are many, at the means of neighbours.
struct Changes {
  std::vector<double> time_s;
  std::vector<Estimate> value;
};

Changes changes_of(const DriftAxis& axis, const MeasuredDrift& drift, const std::vector<std::size_t>& rows) {
  Changes changes;
  std::vector<double> values;
  std::size_t reference = 0;
  for (const std::size_t row : rows) {
    if (std::abs(drift.time_s[row] - drift.reference_s) < std::abs(drift.time_s[rows[reference]] - drift.reference_s))
      reference = values.size();
    changes.time_s.push_back(drift.time_s[row]);
    values.push_back(axis.value[row]);
  }
  if (values.size() < kFewestForCurve) {
    for (const std::size_t row : rows) changes.value.push_back({axis.value[row], sigma_of(axis, row)});
    return changes;
  }
  const std::size_t block = average_blocks(changes.time_s, values, kMostOfCurve);
  changes.value = smooth_changes(changes.time_s, values, std::min(reference / block, values.size() - 1));
  for (std::size_t i = 0; i < values.size(); ++i) {
    double square = changes.value[i].sigma_um * changes.value[i].sigma_um;
    for (const Contribution& one : axis.budget) {
      const double sigma = one.sigma[rows[std::min(i * block, rows.size() - 1)]];
      if (!one.noise && std::isfinite(sigma)) square += sigma * sigma;
    }
    changes.value[i].sigma_um = std::sqrt(square);
  }
  return changes;
}

ThermalTestKind kind_of(const Column& column) {
  if (column.role != Role::speed)
    return unit_of(column.name) == kFeeds[0] ? ThermalTestKind::linear_axes : ThermalTestKind::rotary_axes;
  const bool is_axis = std::any_of(std::begin(kRotaryAxes), std::end(kRotaryAxes),
                                   [&](const char* letter) { return has_word(shown_name(column), letter); });
  return is_axis ? ThermalTestKind::rotary_axes : ThermalTestKind::spindle;
}

// Of the first column that moves for more than a minute: a speed, a feed, a turn. Else of the first speed.
AxisMotion motion_in(std::span<const Series> signals, double from_s, double to_s) {
  AxisMotion still;
  for (const char* unit : {"", kFeeds[0], kFeeds[1]}) {
    for (const Series& series : signals) {
      for (const Column& column : series.columns) {
        const bool is_speed = column.role == Role::speed;
        if (*unit == 0 ? !is_speed : unit_of(column.name) != unit) continue;
        AxisMotion motion = motion_in(series, column, from_s, to_s);
        if (motion.running_s > std::min(kShortest_s, 0.1 * (to_s - from_s))) return motion;
        if (is_speed && still.column == nullptr) still = std::move(motion);
      }
    }
  }
  still.running_s = 0.0;
  return still;
}

}  // namespace

std::string_view name_of(ThermalTestKind kind) {
  constexpr std::array<std::string_view, 6> kNames{"unknown",          "environment", "spindle",
                                                   "spindle_spectrum", "linear_axes", "rotary_axes"};
  return kNames[static_cast<std::size_t>(kind)];
}

std::string_view name_of(TestLack lack) {
  constexpr std::array<std::string_view, 5> kNames{"speed", "room_temperature", "structure_temperature", "a_day",
                                                   "rest_after"};
  return kNames[static_cast<std::size_t>(lack)];
}

ThermalTest thermal_test(std::span<const Series> signals, double from_s, double to_s) {
  ThermalTest test;
  test.from_s = from_s;
  test.duration_s = to_s - from_s;
  test.temperatures = temperatures_of(signals, from_s, to_s);
  if (const AxisMotion motion = motion_in(signals, from_s, to_s); motion.column != nullptr) {
    const bool is_moving = motion.running_s > 0.0;
    test.kind = is_moving ? kind_of(*motion.column) : ThermalTestKind::environment;
    test.motion = shown_name(*motion.column);
    test.motion_unit = unit_of(motion.column->name);
    test.running_s = motion.running_s;
    test.rest_after_s = is_moving ? motion.rest_after_s : 0.0;
    double longest_s = 0.0;
    for (const auto& [size, lasts_s] : motion.levels) longest_s = std::max(longest_s, lasts_s);
    const double least_s = std::min(kLeastShare * motion.running_s, longest_s);
    for (const auto& [size, lasts_s] : motion.levels) {
      if (is_moving && lasts_s >= least_s && test.speeds.size() < kMostSpeeds) test.speeds.push_back(size);
    }
    std::sort(test.speeds.begin(), test.speeds.end());
    if (test.kind == ThermalTestKind::spindle && longest_s < (1.0 - kLeastShare) * motion.running_s)
      test.kind = ThermalTestKind::spindle_spectrum;
  }
  test.lacks = lacks_of(test);
  return test;
}

const Column* motion_of(const Series& series) {
  if (series.time_s.empty()) return nullptr;
  const AxisMotion motion = motion_in(std::span(&series, 1), series.time_s.front(), series.time_s.back());
  return motion.running_s > 0.0 ? motion.column : nullptr;
}

std::vector<LargestDrift> largest_drifts(const MeasuredDrift& drift) {
  std::vector<LargestDrift> all;
  const std::size_t n = drift.time_s.size();
  std::vector<std::size_t> rows(n);
  for (const DriftAxis& axis : drift.axes) {
    rows.resize(n);
    std::iota(rows.begin(), rows.end(), std::size_t{0});
    std::erase_if(rows, [&](std::size_t row) { return std::isnan(axis.value[row]); });
    const Changes changes = changes_of(axis, drift, rows);
    if (rows.empty()) continue;
    std::size_t largest = 0;
    for (std::size_t i = 1; i < changes.value.size(); ++i) {
      if (std::abs(changes.value[i].value_um) > std::abs(changes.value[largest].value_um)) largest = i;
    }
    all.push_back({axis.name, axis.unit, changes.value[largest], changes.time_s[largest]});
  }
  std::vector<const DriftAxis*> axes;
  std::string name;
  for (const char letter : {'x', 'y', 'z'}) {
    const DriftAxis* axis = axis_along(drift, letter);
    if (axis == nullptr || axis->unit != "um") continue;
    axes.push_back(axis);
    name += fmt::format("{}{}", name.empty() ? "combined " : ", ", letter);
  }
  if (axes.size() < 2) return all;
  rows.resize(n);
  std::iota(rows.begin(), rows.end(), std::size_t{0});
  std::erase_if(rows, [&](std::size_t row) {
    return std::any_of(axes.begin(), axes.end(), [&](const DriftAxis* axis) { return std::isnan(axis->value[row]); });
  });
  if (rows.empty()) return all;
  std::vector<Changes> each;
  each.reserve(axes.size());
  for (const DriftAxis* axis : axes) each.push_back(changes_of(*axis, drift, rows));
  std::optional<LargestDrift> largest;
  for (std::size_t i = 0; i < each.front().value.size(); ++i) {
    DriftPoint point;
    point.x = each[0].value[i], point.y = each[1].value[i];
    if (axes.size() == 3) point.z = each[2].value[i];
    const Estimate one = *combined_drift(point);
    if (!largest || one.value_um > largest->drift.value_um)
      largest = LargestDrift{axes.size() == 3 ? "combined" : name, "um", one, each.front().time_s[i]};
  }
  all.push_back(*largest);
  return all;
}

std::vector<LargestDrift> largest_drifts(const DriftSeries& series) {
  std::vector<LargestDrift> all;
  const auto add = [&](const char* axis, auto value_of) {
    std::optional<LargestDrift> largest;
    for (const DriftPoint& point : series.points) {
      const std::optional<Estimate> now = value_of(point);
      if (now && (!largest || std::abs(now->value_um) > std::abs(largest->drift.value_um)))
        largest = LargestDrift{axis, "um", *now, point.time_s};
    }
    if (largest) all.push_back(*largest);
  };
  for (const DriftQuantity& quantity : kDriftQuantities)
    add(quantity.name, [&](const DriftPoint& point) { return point.*quantity.member; });
  std::string axes;
  const auto has = [&](std::optional<Estimate> DriftPoint::*member) {
    return std::any_of(series.points.begin(), series.points.end(),
                       [&](const DriftPoint& point) { return (point.*member).has_value(); });
  };
  const std::array members{&DriftPoint::x, &DriftPoint::y, &DriftPoint::z};
  for (std::size_t k = 0; k < members.size(); ++k) {
    if (has(members[k])) axes += fmt::format("{}{}", axes.empty() ? "combined " : ", ", "xyz"[k]);
  }
  const bool is_of_all = axes == "combined x, y, z";
  add(is_of_all ? "combined" : axes.c_str(), [&](const DriftPoint& point) {
    const bool lacks_one = std::any_of(members.begin(), members.end(), [&](auto member) { return !(point.*member); });
    return is_of_all && lacks_one ? std::nullopt : combined_drift(point);
  });
  return all;
}

}  // namespace ballbar
