#include <fmt/format.h>

#include <algorithm>
#include <cassert>

#include "ballbar/compensation/compensation.hpp"
#include "ballbar/error.hpp"

namespace ballbar {

CompensatedAxes::CompensatedAxes(const std::vector<CompensatedAxis>& axes, const CompensationLimits& limits) {
  if (axes.empty()) throw Error("expected at least one axis to compensate, found none.");
  for (auto axis = axes.begin(); axis != axes.end(); ++axis) {
    const auto same = [&](const CompensatedAxis& other) { return other.name == axis->name; };
    if (std::any_of(axes.begin(), axis, same)) {
      throw Error(fmt::format("expected each axis once, found {} again.", axis->name));
    }
    const auto is_predicted = [&](const ColumnRange& range) {
      return std::any_of(axes.begin(), axis,
                         [&](const CompensatedAxis& other) { return other.model.targets.front() == range.column; });
    };
    Model model = axis->model;
    std::erase_if(model.trained, is_predicted);
    try {
      axes_.emplace_back(axis->name, model, limits);
    } catch (const Error& error) {
      throw Error(fmt::format("{}: {}", axis->name, error.what()));
    }
    Axis& made = axes_.back();
    for (const std::string& column : made.compensator.columns()) {
      const auto predicts = [&](const CompensatedAxis& other) { return other.model.targets.front() == column; };
      const auto by = std::find_if(axes.begin(), axis, predicts);
      if (by != axis) {
        made.sources.push_back({true, static_cast<std::size_t>(by - axes.begin())});
        continue;
      }
      const auto known = std::find(columns_.begin(), columns_.end(), column);
      made.sources.push_back({false, static_cast<std::size_t>(known - columns_.begin())});
      if (known == columns_.end()) columns_.push_back(column);
    }
    made.values.resize(made.sources.size());
  }
  offsets_.resize(axes_.size());
}

std::span<const Offset> CompensatedAxes::next(double time_s, std::span<const double> values) {
  assert(values.size() == columns_.size());
  for (std::size_t a = 0; a < axes_.size(); ++a) {
    Axis& axis = axes_[a];
    for (std::size_t k = 0; k < axis.sources.size(); ++k) {
      const Source& source = axis.sources[k];
      axis.values[k] = source.predicted ? offsets_[source.index].predicted_um : values[source.index];
    }
    offsets_[a] = axis.compensator.next(time_s, axis.values);
  }
  return offsets_;
}

}  // namespace ballbar
