#include "measure/drift_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ballbar/units.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar {
namespace {

std::string largest(const DriftSeries& series, const DriftQuantity& quantity) {
  const DriftPoint* best = nullptr;
  for (const DriftPoint& point : series.points) {
    const auto& now = point.*quantity.member;
    if (!now) continue;
    if (best == nullptr || std::abs(now->value_um) > std::abs((best->*quantity.member)->value_um)) best = &point;
  }
  return fmt::format("{} {} um at {:g} min", quantity.name, with_sigma(*(best->*quantity.member)),
                     min_from_s(best->time_s));
}

}  // namespace

bool any_has(const DriftSeries& series, std::optional<Estimate> DriftPoint::*member) {
  return std::any_of(series.points.begin(), series.points.end(),
                     [&](const DriftPoint& point) { return (point.*member).has_value(); });
}

std::vector<std::string> largest_drifts(const DriftSeries& series) {
  std::vector<std::string> texts;
  for (const DriftQuantity& quantity : kDriftQuantities) {
    if (any_has(series, quantity.member)) texts.push_back(largest(series, quantity));
  }
  return texts;
}

}  // namespace ballbar
