// An effect of a drift series on a few rows.
#pragma once

#include <string_view>
#include <vector>

#include "ballbar/effects/effect.hpp"

namespace ballbar {

struct DriftValues {
  std::vector<double> values;       // a row
  std::vector<double> derivatives;  // row by row
};

inline DriftValues drift_values(std::string_view name, const std::vector<double>& time_s,
                                const std::vector<std::vector<double>>& inputs, const std::vector<double>& parameters) {
  const Effect& effect = *find_effect(name, Level::series);
  EffectRows rows;
  rows.time_s = time_s;
  for (const std::vector<double>& input : inputs) rows.inputs.emplace_back(input);
  DriftValues result;
  result.values.resize(time_s.size());
  result.derivatives.resize(time_s.size() * parameters.size());
  effect.evaluate(rows, parameters.data(), result.values.data(), result.derivatives.data());
  return result;
}

}  // namespace ballbar
