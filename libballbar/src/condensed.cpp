#include "condensed.hpp"

#include <algorithm>
#include <cmath>

#include "ballbar/units.hpp"

namespace ballbar {

Series condensed(const Series& data, const std::string& target, std::size_t most) {
  const std::vector<double>& values = find_column(data, target)->values;
  const auto known = static_cast<std::size_t>(
      std::count_if(values.begin(), values.end(), [](double value) { return !std::isnan(value); }));
  if (known <= most) return data;
  const std::size_t each = (known + most - 1) / most;
  // First row of every mean; a mean holds rows of one recording.
  const Column* recording = find_column(data, "recording");
  std::vector<std::size_t> first{0};
  for (std::size_t row = 1; row < data.time_s.size(); ++row) {
    const bool other = recording != nullptr && recording->values[row] != recording->values[row - 1];
    if (other || row - first.back() == each) first.push_back(row);
  }
  const std::size_t rows = first.size();
  first.push_back(data.time_s.size());
  // Of angles: about the first of the mean's rows, so that a turn's end does not matter.
  const auto mean_angles = [&](const std::vector<double>& column) {
    std::vector<double> result(rows, 0.0);
    for (std::size_t k = 0; k < rows; ++k) {
      for (std::size_t row = first[k]; row < first[k + 1]; ++row) {
        result[k] += std::remainder(column[row] - column[first[k]], 2.0 * kPi);
      }
      result[k] = column[first[k]] + result[k] / static_cast<double>(first[k + 1] - first[k]);
    }
    return result;
  };
  const auto means = [&](const std::vector<double>& column, bool sigma) {
    std::vector<double> result(rows, 0.0);
    for (std::size_t k = 0; k < rows; ++k) {
      for (std::size_t row = first[k]; row < first[k + 1]; ++row) {
        result[k] += sigma ? column[row] * column[row] : column[row];
      }
      const auto count = static_cast<double>(first[k + 1] - first[k]);
      result[k] = sigma ? std::sqrt(result[k]) / count : result[k] / count;
    }
    return result;
  };
  Series result;
  result.time_s = means(data.time_s, false);
  result.five_probe = data.five_probe;
  for (const Column& column : data.columns) {
    const bool sigma = column.name.find("_sigma_") != std::string::npos;
    result.columns.push_back({column.name, column.role,
                              column.name == "angle_rad" ? mean_angles(column.values) : means(column.values, sigma)});
  }
  return result;
}

}  // namespace ballbar
