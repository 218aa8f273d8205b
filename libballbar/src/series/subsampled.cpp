#include "series/subsampled.hpp"

#include <algorithm>
#include <cmath>

#include "numerics/not_finite.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kMostAbout = 120;  // values about a moment

}  // namespace

Series subsampled(const Series& data, const std::string& target, std::size_t most,
                  std::span<const double> whole_about_s) {
  const std::vector<double>& values = find_column(data, target)->values;
  const auto known = static_cast<std::size_t>(
      std::count_if(values.begin(), values.end(), [](double value) { return !std::isnan(value); }));
  if (known <= most) return data;
  const std::size_t each = (known + most - 1) / most;
  Series result = data;
  const auto column =
      std::find_if(result.columns.begin(), result.columns.end(), [&](const Column& one) { return one.name == target; });
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < values.size(); ++row) {
    if (!std::isnan(values[row])) rows.push_back(row);
  }
  std::vector<char> is_kept(rows.size(), 0);
  for (std::size_t k = 0; k < rows.size(); k += each) is_kept[k] = 1;
  for (const double moment_s : whole_about_s) {
    const auto after = static_cast<std::size_t>(
        std::find_if(rows.begin(), rows.end(), [&](std::size_t row) { return data.time_s[row] > moment_s; }) -
        rows.begin());
    const std::size_t first = after - std::min(after, 3 * each), end = std::min(rows.size(), after + 3 * each);
    for (std::size_t k = first; k < end; k += 1 + (end - first) / kMostAbout) is_kept[k] = 1;
  }
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (is_kept[k] == 0) column->values[rows[k]] = kUnknown;
  }
  return result;
}

}  // namespace ballbar
