// The compensators of a machine's axes, fed by one row: each its own columns of it.
//
// A model may read what another one predicts, as the clearance of a bearing follows its axial growth: a column that is
// no signal but the target of an axis named before it takes that axis' predicted error. It counts from that
// axis' first row, so that no trained range of the column as it was measured is looked at. While that axis is held, so
// is this one (no_value).
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
  Model model;       // of one target
};

class CompensatedAxes {
 public:
  // Throws Error: no axis, one named twice, and what Compensator throws, with the axis in front.
  CompensatedAxes(const std::vector<CompensatedAxis>& axes, const CompensationLimits& limits);

  std::size_t size() const { return axes_.size(); }
  const std::string& name(std::size_t axis) const { return axes_[axis].name; }
  Compensator& axis(std::size_t axis) { return axes_[axis].compensator; }
  const Compensator& axis(std::size_t axis) const { return axes_[axis].compensator; }

  // The signals that all of them want, each once.
  std::span<const std::string> columns() const { return columns_; }

  // One an axis, until the next call. values: as columns(). Takes no memory.
  std::span<const Offset> next(double time_s, std::span<const double> values);

 private:
  struct Source {
    bool predicted = false;  // by an axis
    std::size_t index = 0;   // of that axis, or of columns_
  };
  struct Axis {
    Axis(std::string of, const Model& model, const CompensationLimits& limits)
        : name(std::move(of)), compensator(model, limits) {}
    std::string name;
    Compensator compensator;
    std::vector<Source> sources;  // of its columns
    std::vector<double> values;
  };
  std::vector<std::string> columns_;
  std::deque<Axis> axes_;  // a compensator stays where it is
  std::vector<Offset> offsets_;
};

}  // namespace ballbar
