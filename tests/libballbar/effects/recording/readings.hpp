// Single readings of a ballbar, to work an effect's value by hand.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/effects/effect.hpp"
#include "ballbar/units.hpp"

namespace ballbar {

struct Reading {
  double angle_deg = 0.0;
  double direction = 1.0;
  double feed_mm_per_min = 3000.0;
  double radius_mm = 100.0;
  double height_mm = 0.0;
  double sweep_s = 0.0;
  double bar_degC = 20.0;
  double recording = 0.0;
  double time_s = 0.0;
};

// What the effect of that name on a recording adds to each reading.
inline std::vector<double> all_added_um(std::string_view name, const std::vector<double>& parameters,
                                        const std::vector<Reading>& readings) {
  const Effect* const effect = find_effect(name, Level::recording);
  if (effect == nullptr || effect->parameters.size() != parameters.size()) {
    ADD_FAILURE() << "no effect " << name << " with " << parameters.size() << " parameters";
    return std::vector<double>(readings.size());
  }
  std::map<std::string, std::vector<double>> columns;
  std::vector<double> time_s;
  for (const Reading& reading : readings) {
    time_s.push_back(reading.time_s);
    columns["angle"].push_back(rad_from_deg(reading.angle_deg));
    columns["direction"].push_back(reading.direction);
    columns["feed"].push_back(reading.feed_mm_per_min);
    columns["radius"].push_back(reading.radius_mm);
    columns["height"].push_back(reading.height_mm);
    columns["sweep"].push_back(reading.sweep_s);
    columns["bar"].push_back(reading.bar_degC);
    columns["recording"].push_back(reading.recording);
  }
  EffectRows rows{time_s, {}};
  for (const Input& input : effect->inputs) rows.inputs.emplace_back(columns.at(input.role));
  std::vector<double> values(readings.size());
  effect->evaluate(rows, parameters.data(), values.data(), nullptr);
  return values;
}

inline double added_um(std::string_view name, const std::vector<double>& parameters, const Reading& reading) {
  return all_added_um(name, parameters, {reading})[0];
}

constexpr double kCcw = 1.0, kCw = -1.0;
constexpr double kRounding_um = 1e-9;

}  // namespace ballbar
