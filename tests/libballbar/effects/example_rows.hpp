// Made-up rows on which every effect does something: a duty cycle with temperatures, or a CCW and a CW circle.
#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "ballbar/effects/effect.hpp"

namespace ballbar {

struct ExampleRows {
  explicit ExampleRows(const Effect& effect) : ExampleRows(effect, effect.level == Level::series ? 600 : 720) {}

  ExampleRows(const Effect& effect, std::size_t n) {
    time_s.resize(n);
    const double step_s = effect.level == Level::series ? 45.0 : 0.05;
    for (std::size_t i = 0; i < n; ++i) {
      // uneven steps, so that nothing relies on even ones
      time_s[i] = step_s * (static_cast<double>(i) + 0.2 * std::sin(static_cast<double>(i)));
    }
    columns.reserve(effect.inputs.size());
    for (std::size_t k = 0; k < effect.inputs.size(); ++k) columns.push_back(column(effect.inputs[k].role, k, n));
    rows.time_s = time_s;
    for (const std::vector<double>& values : columns) rows.inputs.emplace_back(values);
  }
  ExampleRows(const ExampleRows&) = delete;
  ExampleRows& operator=(const ExampleRows&) = delete;

  std::size_t size() const { return time_s.size(); }

  std::vector<double> time_s;
  std::vector<std::vector<double>> columns;
  EffectRows rows;

 private:
  std::vector<double> column(const std::string& role, std::size_t k, std::size_t n) const {
    std::vector<double> values(n);
    const double turn = 2.0 * std::numbers::pi;
    for (std::size_t i = 0; i < n; ++i) {
      const double share = static_cast<double>(i) / static_cast<double>(n);
      const bool second = 2 * i >= n;
      const double in_sweep = second ? 2.0 * share - 1.0 : 2.0 * share;
      double& value = values[i];
      if (role == "speed") {
        value = std::fmod(6.0 * share, 2.0) < 1.0 ? 0.0 : 2000.0 + 3000.0 * std::floor(3.0 * share);
      } else if (role == "angle") {
        value = second ? turn * (1.0 - in_sweep) - 0.004 : turn * in_sweep + 0.004;
      } else if (role == "direction") {
        value = second ? -1.0 : 1.0;
      } else if (role == "feed") {
        value = second ? 1000.0 : 2000.0;
      } else if (role == "radius") {
        value = 100.0;
      } else if (role == "height") {
        value = 0.0;
      } else if (role == "sweep") {
        value = (in_sweep - 0.5) * 0.05 * static_cast<double>(n) / 2.0;
      } else if (role == "recording") {
        value = second ? 1.0 : 0.0;
      } else if (role == "axial") {
        value = 15.0 * std::sin(3.0 * turn * share) + 4.0 * share;
      } else if (role == "load") {
        value = 3.0 + 2.0 * std::sin(5.0 * turn * share);
      } else {  // temperatures
        const double phase = 0.7 * static_cast<double>(k);
        value = 22.0 + 6.0 * std::sin(turn * (2.0 * share + phase)) + 5.0 * share - 6.0 * std::sin(turn * phase);
      }
    }
    return values;
  }
};

}  // namespace ballbar
