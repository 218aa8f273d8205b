#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "ballbar/drift/drift.hpp"
#include "ballbar/message_catalogue.hpp"
#include "ballbar/units.hpp"
#include "drift/row_scatter.hpp"
#include "numerics/not_finite.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kMostPositions = 12, kFewestRowsAtOne = 6;
constexpr double kFurthest_mm = 1.0, kSameOfRange = 0.002, kScatterFalls = 2.0;

double in_mm(const Column& column, double value) { return unit_of(column.name) == "um" ? mm_from_um(value) : value; }

// The positions of a column that stands at a few of them in turn: each with its rows. Empty: it does not.
std::map<double, std::vector<std::size_t>> positions_of(const Column& column) {
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (const double value : column.values) {
    if (std::isfinite(value)) least = std::min(least, value), most = std::max(most, value);
  }
  std::map<double, std::vector<std::size_t>> positions;
  if (!(in_mm(column, most - least) > kFurthest_mm)) return positions;
  for (std::size_t row = 0; row < column.values.size(); ++row) {
    const double value = column.values[row];
    if (!std::isfinite(value)) continue;
    const auto near = std::find_if(positions.begin(), positions.end(), [&](const auto& one) {
      return std::abs(one.first - value) <= kSameOfRange * (most - least);
    });
    (near != positions.end() ? near->second : positions[value]).push_back(row);
    if (positions.size() > kMostPositions) return {};
  }
  const bool is_few = std::any_of(positions.begin(), positions.end(),
                                  [](const auto& one) { return one.second.size() < kFewestRowsAtOne; });
  return is_few ? std::map<double, std::vector<std::size_t>>() : positions;
}

// Whether the readings lie closer about a slow drift at each position than in all rows.
bool depends_on(const std::vector<double>& time_s, const DriftAxis& axis,
                const std::map<double, std::vector<std::size_t>>& positions) {
  const std::optional<double> all = row_scatter(time_s, axis.value);
  double square = 0.0;
  for (const auto& [position, rows] : positions) {
    std::vector<double> times, values;
    for (const std::size_t row : rows) times.push_back(time_s[row]), values.push_back(axis.value[row]);
    const std::optional<double> scatter = row_scatter(times, values);
    if (!scatter) return false;
    square = std::max(square, *scatter * *scatter);
  }
  return all && *all * *all > kScatterFalls * kScatterFalls * square;
}

// The name without its digits: equal at two positions of one axis.
std::string without_digits(std::string name) {
  std::erase_if(name, [](char c) { return (c >= '0' && c <= '9') || c == '.' || c == '-'; });
  return name;
}

}  // namespace

MeasuredDrift at_each_position(MeasuredDrift drift, const Series& series) {
  for (const Column& along : series.columns) {
    if (unit_of(along.name) != "um" && unit_of(along.name) != "mm") continue;
    const auto positions = positions_of(along);
    if (positions.size() < 2) continue;
    std::vector<DriftAxis> axes;
    for (const DriftAxis& axis : drift.axes) {
      if (fmt::format("{}_{}", axis.name, axis.unit) == along.name || !depends_on(drift.time_s, axis, positions)) {
        axes.push_back(axis);
        continue;
      }
      for (const auto& [position, rows] : positions) {
        DriftAxis one = axis;
        one.name = fmt::format("{} at {:.6g} mm", axis.name, in_mm(along, position));
        std::fill(one.value.begin(), one.value.end(), kUnknown);
        for (const std::size_t row : rows) one.value[row] = axis.value[row];
        axes.push_back(std::move(one));
      }
    }
    if (axes.size() == drift.axes.size()) continue;
    drift.axes = std::move(axes);
    drift.remarks.emplace_back(
        messages::positions_in_turn(positions.size(), along.header.empty() ? along.name : along.header));
    return drift;
  }
  return drift;
}

MeasuredDrift with_lengths(MeasuredDrift drift) {
  const std::size_t n = drift.axes.size();
  for (std::size_t k = 0; k < n; ++k) {
    const auto is_pair = [&](const DriftAxis& other) {
      return other.unit == "um" && drift.axes[k].unit == "um" && other.name.find("mm") != std::string::npos &&
             without_digits(other.name) == without_digits(drift.axes[k].name);
    };
    const auto begin = drift.axes.begin();
    if (std::count_if(begin, begin + static_cast<long>(n), is_pair) != 2 ||
        std::find_if(begin, begin + static_cast<long>(n), is_pair) != begin + static_cast<long>(k))
      continue;
    const DriftAxis first = drift.axes[k];
    const DriftAxis second = *std::find_if(begin + static_cast<long>(k) + 1, begin + static_cast<long>(n), is_pair);
    DriftAxis length{fmt::format("{} less {}", second.name, first.name), "um", {}, {}};
    const auto is_noise = [](const Contribution& one) { return one.noise; };
    const bool all_noise = std::all_of(first.budget.begin(), first.budget.end(), is_noise) &&
                           std::all_of(second.budget.begin(), second.budget.end(), is_noise);
    Contribution noise{"both positions", {}, false, all_noise};
    double last_first = kUnknown, last_second = kUnknown;  // readings may take the positions in turn
    for (std::size_t row = 0; row < drift.time_s.size(); ++row) {
      const bool any = std::isfinite(first.value[row]) || std::isfinite(second.value[row]);
      if (std::isfinite(first.value[row])) last_first = first.value[row];
      if (std::isfinite(second.value[row])) last_second = second.value[row];
      length.value.push_back(any ? last_second - last_first : kUnknown);
      noise.sigma.push_back(std::hypot(sigma_of(first, row), sigma_of(second, row)));
    }
    length.budget.push_back(std::move(noise));
    drift.axes.push_back(std::move(length));
  }
  return drift;
}

}  // namespace ballbar
