// Runs of equal values.
#pragma once

#include <cstddef>
#include <vector>

#include "ballbar/series/series.hpp"

namespace ballbar {

inline std::vector<RowRange> equal_rows(const std::vector<double>& values) {
  std::vector<RowRange> runs;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i == 0 || values[i] != values[i - 1]) runs.push_back({i, i});
    runs.back().end = i + 1;
  }
  return runs;
}

}  // namespace ballbar
