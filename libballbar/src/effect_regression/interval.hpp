// Constants of what is predicted.
#pragma once

#include "ballbar/model/model.hpp"

namespace ballbar {

inline constexpr double kNormal95 = 1.959963984540054;  // sigmas of a 95 % interval

// By a tenth of its span at either end: what is still taken for inside.
inline ColumnRange with_margin(const ColumnRange& range) {
  const double margin = 0.1 * (range.high - range.low);
  return {range.column, range.low - margin, range.high + margin};
}

}  // namespace ballbar
