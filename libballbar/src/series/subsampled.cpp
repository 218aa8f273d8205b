#include "series/subsampled.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ballbar {

Series subsampled(const Series& data, const std::string& target, std::size_t most) {
  const std::vector<double>& values = find_column(data, target)->values;
  const auto known = static_cast<std::size_t>(
      std::count_if(values.begin(), values.end(), [](double value) { return !std::isnan(value); }));
  if (known <= most) return data;
  const std::size_t each = (known + most - 1) / most;
  Series result = data;
  const auto column =
      std::find_if(result.columns.begin(), result.columns.end(), [&](const Column& one) { return one.name == target; });
  std::size_t count = 0;
  for (double& value : column->values) {
    if (!std::isnan(value) && count++ % each != 0) value = std::numeric_limits<double>::quiet_NaN();
  }
  return result;
}

}  // namespace ballbar
