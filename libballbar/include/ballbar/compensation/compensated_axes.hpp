// The compensators of all axes of a machine. All read the same row of signals.
//
// A model may read the prediction of another one, as bearing clearance depends on axial growth. If a column is not a
// signal but the target of an earlier axis, it takes the predicted error of that axis. This value counts from the first
// row of that axis, so that the trained range of the measured column is not checked. While that axis is held, this one
// is held too (no_value).
#pragma once

#include <cstddef>
#include <deque>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "ballbar/compensation/compensation.hpp"

namespace ballbar {

struct CompensatedAxis {
  std::string name;  // "z"
  Model model;       // with one target
};

class CompensatedAxes {
 public:
  // Throws Error: no axis, a name twice, and the errors of Compensator, preceded by the axis.
  CompensatedAxes(const std::vector<CompensatedAxis>& axes, const CompensationLimits& limits);

  std::size_t size() const { return axes_.size(); }
  const std::string& name(std::size_t axis) const { return axes_[axis].name; }
  Compensator& axis(std::size_t axis) { return axes_[axis].compensator; }
  const Compensator& axis(std::size_t axis) const { return axes_[axis].compensator; }

  // The signals that the axes read, each once.
  std::span<const std::string> columns() const { return columns_; }

  // The offset of each axis, valid until the next call. values: in the order of columns(). Allocates no memory.
  std::span<const Offset> next(double time_s, std::span<const double> values);

 private:
  struct Source {
    bool predicted = false;  // the column is the prediction of another axis
    std::size_t index = 0;   // index of that axis, or into columns_
  };
  struct Axis {
    Axis(std::string of, const Model& model, const CompensationLimits& limits)
        : name(std::move(of)), compensator(model, limits) {}
    std::string name;
    Compensator compensator;
    std::vector<Source> sources;  // one per column of the compensator
    std::vector<double> values;
  };
  std::vector<std::string> columns_;
  std::deque<Axis> axes_;  // a deque, because a Compensator does not move
  std::vector<Offset> offsets_;
};

}  // namespace ballbar
