#include "spindle/spindle_cells.hpp"

#include <algorithm>
#include <cmath>

namespace ballbar::thermal {
namespace {

std::vector<Interval> cut(double length_mm, std::size_t cells) {
  std::vector<Interval> result;
  const auto at_mm = [&](std::size_t i) { return length_mm * static_cast<double>(i) / static_cast<double>(cells); };
  for (std::size_t i = 0; i < cells; ++i) result.push_back({at_mm(i), at_mm(i + 1)});
  return result;
}

}  // namespace

Interval common(const Interval& a, const Interval& b) {
  const double from_mm = std::max(a.from_mm, b.from_mm);
  return {from_mm, std::max(from_mm, std::min(a.to_mm, b.to_mm))};
}

double overlap_mm(const Interval& a, const Interval& b) { return common(a, b).length_mm(); }

Shares more_to(Side side, double excess) {
  Shares shares{0.25, 0.25, 0.25, 0.25};
  shares[side] += excess / 4.0;
  shares[(side + 2) % 4] -= excess / 4.0;
  return shares;
}

Cells cells_of(const FiniteVolumeSpindle& spindle) {
  const double cell_mm = spindle.length_mm / spindle.cells;
  const auto housing_cells = static_cast<std::size_t>(std::max(1.0, std::round(spindle.housing_mm / cell_mm)));
  Cells cells;
  cells.shaft = cut(spindle.length_mm, static_cast<std::size_t>(spindle.cells));
  cells.housing = cut(spindle.housing_mm, housing_cells);
  cells.rear = {spindle.rear_from_mm, spindle.rear_to_mm};
  cells.motor = {spindle.motor_from_mm, spindle.motor_to_mm};
  cells.front = {spindle.front_from_mm, spindle.front_to_mm};
  cells.jacket = {spindle.jacket_from_mm, spindle.jacket_to_mm};
  cells.flange = {spindle.flange_mm - spindle.flange_width_mm / 2.0, spindle.flange_mm + spindle.flange_width_mm / 2.0};
  return cells;
}

std::size_t intervals_of(const DutyPlan& plan, const ThermalClock& clock) {
  return static_cast<std::size_t>(std::floor((plan.end_s - plan.time_s.front()) / clock.interval_s + 1e-9));
}

}  // namespace ballbar::thermal
