#include "simulate/spindle_toml.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace ballbar {
namespace {

constexpr double kMinute_s = 60.0;

constexpr Key kSpindleKeys[] = {
    {"time_min", "min, list", "from these times on, rising; needed"},
    {"speed_rpm", "rpm, list", "this speed; needed"},
    {"load_W", "W, list", "and this cutting power; default: none"},
    {"end_min", "min", "when it ends; method \"series\" needs it, a session ends with its last test"},
    {"room_min", "min, list", "times of the room's temperature, straight lines between them"},
    {"room_degC", "degC, list", "at these times; default: 20 degC"},
    {"off", "texts",
     "mechanisms left out: \"viscosity\", \"convection\", \"asymmetry\", \"rings\", \"centrifugal\", \"thermostat\", "
     "\"coolant\", \"room\", \"structure\""},
    {"interval_s", "s", "from row to row; default 15"},
    {"step_s", "s", "longest step of the calculation; default 15"},
    {"profile_min", "min, list", "when the temperature along the shaft is kept; default: never"},
    {"image", "tables", "pictures of that"},
    {"body", "table", "numbers of the spindle"},
    {"measured", "table", "how it is measured"},
};
constexpr Key kMeasuredKeys[] = {
    {"noise_um", "um", "of x, y, z: standard deviation from row to row; default 0.15"},
    {"tail_freedom", "1", "that noise is Student's t with so many degrees of freedom; 0, the default: normal"},
    {"memory_um", "um", "standard deviation of an AR(1) noise beside it; default 0"},
    {"memory_s", "s", "its correlation time; default 600"},
    {"resolution_um", "um", "of x, y, z; default 0.05"},
    {"temperature_noise_K", "K", "standard deviation; default 0.03"},
    {"temperature_resolution_K", "K", "default 0.1"},
    {"not_logged", "texts", "columns of sensors that are left out"},
};

void take_bounded(double& value, const TomlTable& table, std::string_view key, Bound bound) {
  const std::optional<double> read = bound == Bound::positive ? positive(table, key) : number(table, key);
  if (!read) return;
  if (bound == Bound::not_negative && *read < 0.0) fail_kind(table, key, "a number not below 0");
  value = *read;
}

// Times in minutes under `key`, rising, in s.
std::vector<double> rising_s(const TomlTable& table, std::string_view key) {
  std::vector<double> times = required(numbers, table, key);
  if (times.empty()) fail_kind(table, key, "at least one time");
  for (std::size_t i = 1; i < times.size(); ++i) {
    if (times[i] > times[i - 1]) continue;
    fail_at_element(table, key, i,
                    fmt::format("expected rising times for {}, found {} after {}.", key, times[i], times[i - 1]));
  }
  for (double& time : times) time *= kMinute_s;
  return times;
}

std::vector<double> as_many(const TomlTable& table, std::string_view key, std::string_view times, std::size_t count) {
  std::vector<double> values = required(numbers, table, key);
  if (values.size() != count) {
    fail_at_key(
        table, key,
        fmt::format("expected as many values for {} as for {}, {}, found {}.", key, times, count, values.size()));
  }
  return values;
}

std::vector<double> not_negative(const TomlTable& table, std::string_view key, std::size_t count) {
  std::vector<double> values = as_many(table, key, "time_min", count);
  const auto bad = std::find_if(values.begin(), values.end(), [](double value) { return value < 0.0; });
  if (bad == values.end()) return values;
  fail_at_element(table, key, static_cast<std::size_t>(bad - values.begin()),
                  fmt::format("expected numbers not below 0 for {}, found {}.", key, *bad));
}

DutyPlan read_plan(const TomlTable& table, std::optional<double> default_end_s) {
  DutyPlan plan;
  plan.time_s = rising_s(table, "time_min");
  plan.speed_rpm = not_negative(table, "speed_rpm", plan.time_s.size());
  if (has(table, "load_W")) plan.load_W = not_negative(table, "load_W", plan.time_s.size());
  if (has(table, "room_min") || has(table, "room_degC")) {
    plan.room_time_s = rising_s(table, "room_min");
    plan.room_degC = as_many(table, "room_degC", "room_min", plan.room_time_s.size());
  }
  if (!default_end_s || has(table, "end_min")) {
    plan.end_s = required(number, table, "end_min") * kMinute_s;
    if (plan.end_s < plan.time_s.back()) {
      fail_at_key(table, "end_min",
                  fmt::format("expected an end_min at or after the last of time_min, {}, found {}.",
                              plan.time_s.back() / kMinute_s, plan.end_s / kMinute_s));
    }
  } else {
    plan.end_s = std::max(*default_end_s, plan.time_s.back());
  }
  return plan;
}

Mechanisms read_mechanisms(const TomlTable& table) {
  Mechanisms result;
  const std::vector<std::string> off = strings(table, "off").value_or(std::vector<std::string>{});
  for (std::size_t i = 0; i < off.size(); ++i) {
    const auto known = mechanisms();
    const auto mechanism = std::find_if(known.begin(), known.end(), [&](const auto& m) { return m.name == off[i]; });
    if (mechanism == known.end()) {
      std::string names;
      for (const Mechanism& m : known) names += fmt::format("{}{}", names.empty() ? "" : ", ", m.name);
      fail_at_element(table, "off", i, fmt::format("expected one of {} in off, found \"{}\".", names, off[i]));
    }
    result.*mechanism->member = false;
  }
  return result;
}

FiniteVolumeSpindle read_body(const TomlTable& table) {
  std::vector<std::string_view> names;
  for (const SpindleParameter& parameter : spindle_parameters()) names.push_back(parameter.name);
  expect_keys(table, names);
  FiniteVolumeSpindle body;
  for (const SpindleParameter& parameter : spindle_parameters()) {
    take_bounded(body.*parameter.member, table, parameter.name, parameter.bound);
  }
  return body;
}

SpindleMeasurement read_measurement(const TomlTable& table) {
  expect_keys(table, kMeasuredKeys);
  SpindleMeasurement measured;
  take_bounded(measured.noise_um, table, "noise_um", Bound::not_negative);
  take_bounded(measured.tail_freedom, table, "tail_freedom", Bound::not_negative);
  take_bounded(measured.memory_um, table, "memory_um", Bound::not_negative);
  take_bounded(measured.memory_s, table, "memory_s", Bound::positive);
  take_bounded(measured.resolution_um, table, "resolution_um", Bound::not_negative);
  take_bounded(measured.temperature_noise_K, table, "temperature_noise_K", Bound::not_negative);
  take_bounded(measured.temperature_resolution_K, table, "temperature_resolution_K", Bound::not_negative);
  measured.not_logged = strings(table, "not_logged").value_or(std::vector<std::string>{});
  return measured;
}

std::optional<TomlTable> inner(const TomlTable& table, std::string_view key) {
  std::optional<TomlTable> result = subtable(table, key);
  if (result) result->label = fmt::format("[spindle.{}]", key);
  return result;
}

}  // namespace

std::vector<KeyTable> spindle_keys() {
  return {{"`[spindle]`", kSpindleKeys}, {"`[spindle.measured]`", kMeasuredKeys}};
}

VirtualSpindle read_spindle(const TomlTable& table, std::optional<double> default_end_s) {
  expect_keys(table, kSpindleKeys);
  VirtualSpindle spindle;
  take_bounded(spindle.clock.interval_s, table, "interval_s", Bound::positive);
  take_bounded(spindle.clock.step_s, table, "step_s", Bound::positive);
  // The last row is the first at or after the last test.
  if (default_end_s) *default_end_s += spindle.clock.interval_s;
  spindle.plan = read_plan(table, default_end_s);
  spindle.mechanisms = read_mechanisms(table);
  if (has(table, "profile_min")) spindle.clock.profile_s = rising_s(table, "profile_min");
  if (const auto body = inner(table, "body")) spindle.body = read_body(*body);
  if (const auto measured = inner(table, "measured")) spindle.measurement = read_measurement(*measured);
  return spindle;
}

}  // namespace ballbar
