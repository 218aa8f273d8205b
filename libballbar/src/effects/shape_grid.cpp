#include "effects/shape_grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace ballbar {
namespace {

// Places of a kink on the way up; half widths of a loop, of which half the range would be stuck.
constexpr std::array kOfARise{0.02, 0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.35, 0.4, 0.45,
                              0.5,  0.55, 0.6, 0.65, 0.7, 0.75, 0.8, 0.85, 0.9, 0.95};
constexpr std::array kOfALoop{0.02, 0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.35, 0.4, 0.45};

double range_of(std::span<const double> values) {
  if (values.empty()) return 0.0;
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return *high - *low;
}

double range_above_first(std::span<const double> values) {
  return values.empty() ? 0.0 : *std::max_element(values.begin(), values.end()) - values[0];
}

double range_of_input(const Effect& effect, const EffectRows& rows, std::string_view role) {
  for (std::size_t i = 0; i < effect.inputs.size(); ++i) {
    if (effect.inputs[i].role == role) return range_of(rows.inputs[i]);
  }
  return 0.0;
}

double shortest_step(std::span<const double> time_s) {
  double shortest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < time_s.size(); ++i) shortest = std::min(shortest, time_s[i] - time_s[i - 1]);
  return shortest;
}

double largest_input(const Effect& effect, const EffectRows& rows, std::string_view role) {
  for (std::size_t i = 0; i < effect.inputs.size(); ++i) {
    if (effect.inputs[i].role == role) return *std::max_element(rows.inputs[i].begin(), rows.inputs[i].end());
  }
  return 0.0;
}

// Frequencies from lowest to highest in steps of half a cycle over the span.
std::vector<double> frequencies(double lowest, double highest, double span, std::size_t most) {
  std::vector<double> result;
  if (!(span > 0.0) || !(highest > lowest)) return result;
  const double step = std::max(0.5 / span, (highest - lowest) / static_cast<double>(most));
  for (double f = lowest; f <= highest && result.size() < most; f += step) result.push_back(f);
  return result;
}

}  // namespace

std::vector<double> shape_grid(const Effect& effect, std::size_t parameter, const EffectRows& rows, double lower,
                               double upper, std::size_t most) {
  const Parameter& shape = effect.parameters[parameter];
  std::vector<double> grid = shape.grid;
  if (shape.name == "period_s") {
    grid = frequencies(1.0 / upper, 1.0 / lower, range_of(rows.time_s), most);
    for (double& value : grid) value = 1.0 / value;
  } else if (shape.name == "threshold_unit") {
    const double rise = range_above_first(rows.inputs[0]);
    grid.clear();
    for (const double share : kOfARise) grid.push_back(share * rise);
  } else if (shape.name == "half_width_unit") {
    const double range = range_of_input(effect, rows, "signal");
    grid.clear();
    for (const double share : kOfALoop) grid.push_back(share * range);
  } else if (shape.name == "pitch_mm") {
    const double finest = grid.empty() ? lower : std::max(lower, grid.front());
    grid = frequencies(1.0 / upper, 1.0 / finest, 2.0 * largest_input(effect, rows, "radius"), most);
    for (double& value : grid) value = 1.0 / value;
  } else if (shape.name == "frequency_Hz" && !grid.empty()) {
    const double highest = std::min(grid.back(), 0.5 / shortest_step(rows.time_s));
    grid = frequencies(grid.front(), highest, range_of_input(effect, rows, "sweep"), most);
  }
  std::erase_if(grid, [&](double value) { return value < lower || value > upper; });
  return grid;
}

}  // namespace ballbar
