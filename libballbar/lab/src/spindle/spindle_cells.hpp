// How the finite-volume spindle is cut into nodes.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "ballbar/lab/spindle/finite_volume_spindle.hpp"

namespace ballbar::thermal {

struct Interval {
  double from_mm = 0.0, to_mm = 0.0;
  double length_mm() const { return to_mm - from_mm; }
  double middle_mm() const { return (from_mm + to_mm) / 2.0; }
};

// Common part of two intervals, of length 0 or more.
Interval common(const Interval& a, const Interval& b);
double overlap_mm(const Interval& a, const Interval& b);

// Sides of the housing in the order +x, +y, -x, -y; the opposite of side i is i + 2.
enum Side : std::size_t { plus_x, plus_y, minus_x, minus_y };
using Shares = std::array<double, 4>;  // sum 1
Shares more_to(Side side, double excess);

// Nodes: shaft cells, housing cells side by side, then the single bodies.
struct Cells {
  std::vector<Interval> shaft, housing;
  Interval rear, motor, front, jacket, flange;  // along the axis
  Eigen::Index shaft_node(std::size_t cell) const { return static_cast<Eigen::Index>(cell); }
  Eigen::Index housing_node(std::size_t cell, std::size_t side) const {
    return static_cast<Eigen::Index>(shaft.size() + 4 * cell + side);
  }
  Eigen::Index single(std::size_t body) const {
    return static_cast<Eigen::Index>(shaft.size() + 4 * housing.size() + body);
  }
  Eigen::Index rear_bearing() const { return single(0); }
  Eigen::Index front_bearing() const { return single(1); }
  Eigen::Index jacket_water() const { return single(2); }
  Eigen::Index tank() const { return single(3); }
  Eigen::Index head() const { return single(4); }
  Eigen::Index column_front() const { return single(5); }
  Eigen::Index column_back() const { return single(6); }
  Eigen::Index nodes() const { return single(7); }
};

Cells cells_of(const FiniteVolumeSpindle& spindle);

// Throws Error, "spindle: ...", where a value makes no sense.
void check(const FiniteVolumeSpindle& spindle);
void check(const DutyPlan& plan, const ThermalClock& clock);

// Rows after the first.
std::size_t intervals_of(const DutyPlan& plan, const ThermalClock& clock);

}  // namespace ballbar::thermal
