#include "ballbar/series/column_faults.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "ballbar/numerics/order_statistic.hpp"

namespace ballbar {
namespace {

constexpr double kFarJump = 20.0, kLongPause = 10.0;

// Rows whose value is away from both neighbours, to the same side.
std::vector<std::size_t> spikes(const std::vector<double>& values) {
  std::vector<double> steps;
  steps.reserve(values.size());
  for (std::size_t i = 1; i < values.size(); ++i) {
    const double step = std::abs(values[i] - values[i - 1]);
    if (step > 0.0) steps.push_back(step);  // of those that are no rest: the least is what values are written to
  }
  const double usual = steps.empty() ? 0.0 : median(std::move(steps));
  std::vector<std::size_t> rows;
  for (std::size_t i = 1; i + 1 < values.size() && usual > 0.0; ++i) {
    const double before = values[i] - values[i - 1], after = values[i] - values[i + 1];
    if (before * after > 0.0 && std::min(std::abs(before), std::abs(after)) > kFarJump * usual &&
        std::abs(values[i + 1] - values[i - 1]) < 0.2 * std::abs(before)) {
      rows.push_back(i);
    }
  }
  return rows;
}

}  // namespace

std::vector<ColumnFault> column_faults(const Series& series) {
  std::vector<ColumnFault> faults;
  std::vector<double> steps_s;
  steps_s.reserve(series.time_s.size());
  for (std::size_t i = 1; i < series.time_s.size(); ++i) steps_s.push_back(series.time_s[i] - series.time_s[i - 1]);
  const double usual_s = median_step_s(series.time_s);
  const auto pause = std::max_element(steps_s.begin(), steps_s.end());
  if (pause != steps_s.end() && *pause > kLongPause * usual_s) {
    const auto count =
        std::count_if(steps_s.begin(), steps_s.end(), [&](double step) { return step > kLongPause * usual_s; });
    faults.push_back({"", fmt::format("{} {} of more than {:g} s, the longest of {:g} s at {:g} s", count,
                                      count == 1 ? "pause" : "pauses", kLongPause * usual_s, *pause,
                                      series.time_s[static_cast<std::size_t>(pause - steps_s.begin())])});
  }
  for (const Column& column : series.columns) {
    std::vector<double> values;
    values.reserve(column.values.size());
    for (const double value : column.values) {
      if (std::isfinite(value)) values.push_back(value);
    }
    if (values.size() < 3) {
      faults.push_back({column.name, "has fewer than three values"});
      continue;
    }
    const std::size_t gaps = column.values.size() - values.size();
    if (gaps * 20 > column.values.size()) {
      faults.push_back({column.name, fmt::format("{:.0f} % gaps", 100.0 * static_cast<double>(gaps) /
                                                                      static_cast<double>(column.values.size()))});
    }
    const auto differs =
        std::find_if(values.rbegin(), values.rend(), [&](double value) { return value != values.back(); });
    if (differs == values.rend()) {
      faults.push_back({column.name, fmt::format("does not change: {:g} in all rows", values.back())});
      continue;
    }
    const auto still = static_cast<std::size_t>(differs - values.rbegin());
    // A speed rests, and so do events; a temperature or a probe never for long.
    if (column.role != Role::speed && column.role != Role::event && column.role != Role::load &&
        still * 10 > values.size() && still > 20) {
      faults.push_back(
          {column.name, fmt::format("does not change any more in the last {} rows: {:g}", still, values.back())});
    }
    if (column.role == Role::speed || column.role == Role::event || column.role == Role::load) continue;
    const std::vector<std::size_t> rows = spikes(values);
    if (!rows.empty()) {
      faults.push_back(
          {column.name, fmt::format("{} single {} far off, the first {:g} between {:g} and {:g}", rows.size(),
                                    rows.size() == 1 ? "value" : "values", values[rows.front()],
                                    values[rows.front() - 1], values[rows.front() + 1])});
    }
  }
  return faults;
}

}  // namespace ballbar
