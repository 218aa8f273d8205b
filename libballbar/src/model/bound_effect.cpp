#include <fmt/format.h>
#include <fmt/ranges.h>

#include "ballbar/model/model.hpp"

namespace ballbar {

std::string label_of(const BoundEffect& bound) {
  // On recordings the columns are the trace's own.
  if (bound.columns.empty() || bound.effect->level == Level::recording) return bound.effect->name;
  return fmt::format("{}({})", bound.effect->name, fmt::join(bound.columns, ", "));
}

}  // namespace ballbar
