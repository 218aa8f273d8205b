#include "condensed.hpp"

#include <algorithm>
#include <cmath>

namespace ballbar {

Series condensed(const Series& data, const std::string& target, std::size_t most) {
  const std::vector<double>& values = find_column(data, target)->values;
  const auto known = static_cast<std::size_t>(
      std::count_if(values.begin(), values.end(), [](double value) { return !std::isnan(value); }));
  if (known <= most) return data;
  const std::size_t each = (known + most - 1) / most;
  const std::size_t rows = (data.time_s.size() + each - 1) / each;
  const auto means = [&](const std::vector<double>& column, bool sigma) {
    std::vector<double> result(rows, 0.0);
    for (std::size_t k = 0; k < rows; ++k) {
      const std::size_t end = std::min(column.size(), (k + 1) * each);
      for (std::size_t row = k * each; row < end; ++row) result[k] += sigma ? column[row] * column[row] : column[row];
      const auto count = static_cast<double>(end - k * each);
      result[k] = sigma ? std::sqrt(result[k]) / count : result[k] / count;
    }
    return result;
  };
  Series result;
  result.time_s = means(data.time_s, false);
  result.five_probe = data.five_probe;
  for (const Column& column : data.columns) {
    const bool sigma = column.name.find("_sigma_") != std::string::npos;
    result.columns.push_back({column.name, column.role, means(column.values, sigma)});
  }
  return result;
}

}  // namespace ballbar
