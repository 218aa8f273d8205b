#include "ballbar/drift/thermal_test.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "ballbar/series/speed_steps.hpp"
#include "ballbar/units.hpp"
#include "numerics/not_finite.hpp"

namespace ballbar {
namespace {

constexpr double kAtRest_rpm = 1.0, kAtRest_mm_per_min = 1.0, kAtRest_deg_per_min = 1.0;
constexpr double kDay_s = 86400.0, kShortRest_s = 600.0;
constexpr double kLeastShare = 0.05;  // of the time at speed
constexpr std::size_t kMostSpeeds = 20;

// The first column that `is_it` holds for, with the clock of its series.
struct Signal {
  const Series* series = nullptr;
  const Column* column = nullptr;
};
template <class IsIt>
Signal first_of(std::span<const Series> signals, IsIt is_it) {
  for (const Series& series : signals) {
    for (const Column& column : series.columns) {
      if (is_it(column)) return {&series, &column};
    }
  }
  return {};
}

struct TimeAtSpeed {
  double running_s = 0.0, rest_after_s = 0.0, largest = 0.0;
  std::vector<std::pair<double, double>> levels;  // speed, s
};

// The time at each speed. Neighbouring levels are joined as they come, by 2 % of the largest.
TimeAtSpeed time_at_speed(const Signal& signal, double at_rest, double from_s, double to_s) {
  TimeAtSpeed motion;
  for (const double speed : signal.column->values) {
    if (std::isfinite(speed)) motion.largest = std::max(motion.largest, std::abs(speed));
  }
  const std::vector<double>& time_s = signal.series->time_s;
  std::vector<SpeedStep> steps = speed_steps(time_s, *signal.column);
  for (std::size_t k = 0; k < steps.size(); ++k) {
    const double begin_s = std::clamp(time_s[steps[k].begin], from_s, to_s);
    const double end_s = k + 1 < steps.size() ? std::clamp(time_s[steps[k + 1].begin], from_s, to_s) : to_s;
    const double size = std::abs(steps[k].speed_rpm), lasts_s = std::max(0.0, end_s - begin_s);
    if (size <= at_rest) {
      motion.rest_after_s += lasts_s;
      continue;
    }
    motion.rest_after_s = 0.0;
    motion.running_s += lasts_s;
    const auto level = std::find_if(motion.levels.begin(), motion.levels.end(), [&](const auto& one) {
      return std::abs(one.first - size) <= 0.02 * motion.largest;
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
      TemperatureSpan span{column.header.empty() ? column.name : column.header, column.role, kUnknown, 0.0, 0.0};
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

// Whether a word of the name, of Latin letters alone, is the letter or d and the letter.
bool has_word(std::string_view name, char letter) {
  std::string word;
  const auto is_it = [&] { return word == std::string(1, letter) || word == std::string{'d', letter}; };
  for (const char c : name) {
    const bool is_large = c >= 'A' && c <= 'Z';
    if (is_large || (c >= 'a' && c <= 'z')) {
      word += is_large ? static_cast<char>(c - 'A' + 'a') : c;
    } else if (is_it()) {
      return true;
    } else {
      word.clear();
    }
  }
  return is_it();
}

const DriftAxis* axis_along(const MeasuredDrift& drift, char letter) {
  if (const DriftAxis* axis = find_axis(drift, std::string(1, letter))) return axis;
  const DriftAxis* found = nullptr;
  for (const DriftAxis& axis : drift.axes) {
    if (!has_word(axis.name, letter)) continue;
    if (found != nullptr) return nullptr;
    found = &axis;
  }
  return found;
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
  test.duration_s = to_s - from_s;
  test.temperatures = temperatures_of(signals, from_s, to_s);
  const Signal speed = first_of(signals, [](const Column& column) { return column.role == Role::speed; });
  const Signal feed = first_of(signals, [](const Column& column) { return unit_of(column.name) == "mm_per_min"; });
  const Signal turn = first_of(signals, [](const Column& column) { return unit_of(column.name) == "deg_per_min"; });
  const auto name_of = [](const Column& column) { return column.header.empty() ? column.name : column.header; };
  const auto take = [&](const Signal& signal, double at_rest, ThermalTestKind kind) {
    if (signal.column == nullptr) return false;
    const TimeAtSpeed motion = time_at_speed(signal, at_rest, from_s, to_s);
    if (motion.largest <= at_rest) return false;
    test.kind = kind;
    test.motion = name_of(*signal.column);
    test.running_s = motion.running_s;
    test.rest_after_s = motion.rest_after_s;
    if (kind != ThermalTestKind::spindle) return true;
    double longest_s = 0.0;
    for (const auto& [size, lasts_s] : motion.levels) {
      longest_s = std::max(longest_s, lasts_s);
      if (lasts_s >= kLeastShare * motion.running_s && test.speeds_rpm.size() < kMostSpeeds)
        test.speeds_rpm.push_back(size);
    }
    std::sort(test.speeds_rpm.begin(), test.speeds_rpm.end());
    if (longest_s < (1.0 - kLeastShare) * motion.running_s) test.kind = ThermalTestKind::spindle_spectrum;
    return true;
  };
  const bool is_moving = take(speed, kAtRest_rpm, ThermalTestKind::spindle) ||
                         take(feed, kAtRest_mm_per_min, ThermalTestKind::linear_axes) ||
                         take(turn, kAtRest_deg_per_min, ThermalTestKind::rotary_axes);
  if (!is_moving && speed.column != nullptr) {
    test.kind = ThermalTestKind::environment;
    test.motion = name_of(*speed.column);
  }
  test.lacks = lacks_of(test);
  return test;
}

std::vector<LargestDrift> largest_drifts(const MeasuredDrift& drift) {
  std::vector<LargestDrift> all;
  const auto take = [](std::optional<LargestDrift>& largest, const LargestDrift& one) {
    if (!largest || std::abs(one.drift.value_um) > std::abs(largest->drift.value_um)) largest = one;
  };
  for (const DriftAxis& axis : drift.axes) {
    std::optional<LargestDrift> largest;
    for (std::size_t row = 0; row < axis.value.size(); ++row) {
      if (std::isnan(axis.value[row])) continue;
      take(largest, {axis.name, axis.unit, {axis.value[row], sigma_of(axis, row)}, drift.time_s[row]});
    }
    if (largest) all.push_back(*largest);
  }
  const DriftAxis* const axes[] = {axis_along(drift, 'x'), axis_along(drift, 'y'), axis_along(drift, 'z')};
  std::optional<LargestDrift> largest;
  for (std::size_t row = 0; row < drift.time_s.size(); ++row) {
    const auto of = [&](const DriftAxis* axis) -> std::optional<Estimate> {
      if (axis == nullptr || axis->unit != "um" || std::isnan(axis->value[row])) return std::nullopt;
      return Estimate{axis->value[row], sigma_of(*axis, row)};
    };
    DriftPoint point;
    point.x = of(axes[0]), point.y = of(axes[1]), point.z = of(axes[2]);
    if (const std::optional<Estimate> one = combined_drift(point))
      take(largest, {"combined", "um", *one, drift.time_s[row]});
  }
  if (largest) all.push_back(*largest);
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
  add("combined", [](const DriftPoint& point) { return combined_drift(point); });
  return all;
}

}  // namespace ballbar
