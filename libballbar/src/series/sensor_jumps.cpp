#include "ballbar/internal/series/sensor_jumps.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <numeric>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "ballbar/internal/numerics/order_statistic.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kRowsAboutOffset = 8, kRowsOfTrend = 4, kMostOffsets = 2;
constexpr double kFarLarger = 5.0, kEven = 1.5, kLongestStep_s = 120.0;
constexpr std::size_t kBeforeOffset = 5, kBehindOffset = 2;  // rows in which another column changes with it

// The change from the row before, less the median of those of the rows about it. A gap has none.
double sudden_change(const std::vector<double>& values, std::size_t row) {
  const std::size_t first = row < kRowsOfTrend ? 0 : row - kRowsOfTrend,
                    end = std::min(values.size(), row + kRowsOfTrend + 1);
  std::vector<double> changes;
  for (std::size_t i = first; i < end; ++i) {
    const double change = i > 0 ? values[i] - values[i - 1] : 0.0;
    changes.push_back(std::isfinite(change) ? change : 0.0);
  }
  return changes[row - first] - median(changes);
}

// The median of the changes that are not zero.
double usual_change(const std::vector<double>& values) {
  std::vector<double> sizes;
  for (std::size_t i = 1; i < values.size(); ++i) {
    const double size = std::abs(values[i] - values[i - 1]);
    if (size > 1e-9) sizes.push_back(size);
  }
  return sizes.empty() ? 0.0 : median(std::move(sizes));
}

// The jump in a parabola, and the rms of what both leave.
struct LocalJump {
  double size = 0.0, residual = 0.0;
};
LocalJump local_jump(const std::vector<double>& values, std::size_t row) {
  constexpr auto n = static_cast<Eigen::Index>(2 * kRowsAboutOffset);
  Eigen::Matrix<double, n, 4> columns;
  Eigen::Matrix<double, n, 1> y;
  for (Eigen::Index i = 0; i < n; ++i) {
    const double at = static_cast<double>(i) - 0.5 * static_cast<double>(n - 1);
    columns.row(i) << 1.0, at, at * at, at > 0.0 ? 1.0 : 0.0;
    y[i] = values[row - kRowsAboutOffset + static_cast<std::size_t>(i)];
  }
  const Eigen::Vector4d curve = columns.colPivHouseholderQr().solve(y);
  return {curve[3], std::sqrt((y - columns * curve).squaredNorm() / static_cast<double>(n))};
}

bool is_even_about(const std::vector<double>& time_s, std::size_t row, double step_s) {
  for (std::size_t i = row + 1 - kRowsAboutOffset; i < row + kRowsAboutOffset; ++i)
    if (time_s[i] - time_s[i - 1] > kEven * step_s) return false;
  return true;
}

// The median of the sudden changes, and half of that of the changes at least.
double usual_sudden_change(const std::vector<double>& values) {
  std::vector<double> sizes;
  sizes.reserve(values.size());
  for (std::size_t row = 0; row < values.size(); ++row) sizes.push_back(std::abs(sudden_change(values, row)));
  return std::max(median(std::move(sizes)), 0.5 * usual_change(values));
}

// usual: of the column, found when it is asked for.
bool changes_suddenly_about(const Column& other, std::size_t row, std::optional<double>& usual) {
  const std::size_t first = row - kBeforeOffset, last = std::min(other.values.size() - 1, row + kBehindOffset);
  const bool is_stepped = other.role == Role::speed || other.role == Role::load || other.role == Role::event;
  if (!is_stepped && !usual) usual = usual_sudden_change(other.values);
  for (std::size_t i = first; i <= last; ++i) {
    if (is_stepped ? other.values[i] != other.values[i - 1]
                   : std::abs(sudden_change(other.values, i)) > 2.0 * kFarLarger * *usual)
      return true;
  }
  return false;
}

// Of metal.
bool is_on_a_body(const Column& column) {
  const std::string_view unit = unit_of(column.name);
  return (unit == "degC" || unit == "K") &&
         (column.role == Role::structure || column.role == Role::housing || column.role == Role::bearing);
}

// Whether the column changes at every second, third ... row alone.
bool is_held_for_rows(const std::vector<double>& values) {
  std::size_t common = 0, before = 0;
  for (std::size_t i = 1; i < values.size() && common != 1; ++i) {
    if (values[i] == values[i - 1]) continue;
    if (before > 0) common = std::gcd(common, i - before);
    before = i;
  }
  return common > 1;
}

// Whether as many rows as are looked at on either side of a jump have one value.
bool stands_still(const std::vector<double>& values, std::size_t first) {
  const auto begin = values.begin() + static_cast<std::ptrdiff_t>(first);
  return std::all_of(begin, begin + kRowsAboutOffset, [&](double value) { return value == *begin; });
}

struct Jump {
  std::size_t row = 0;  // the first behind it
  double size = 0.0;
};

// Those of a column of one run.
std::vector<Jump> jumps_of(const Series& data, const Column& column, std::vector<std::optional<double>>& usual) {
  const std::vector<double>& values = column.values;
  const double step_s = median_step_s(data.time_s);
  if (!is_on_a_body(column) || step_s > kLongestStep_s || is_held_for_rows(values) ||
      !std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); }))
    return {};
  const double least = kFarLarger * usual_change(values);
  std::vector<Jump> jumps;
  for (std::size_t row = kRowsAboutOffset; row + kRowsAboutOffset <= values.size(); ++row) {
    if (!(2.0 * std::abs(values[row] - values[row - 1]) > least)) continue;
    const double size = std::abs(sudden_change(values, row));
    if (!(size > least)) continue;
    double largest = 0.0;
    for (std::size_t i = row + 1 - kRowsAboutOffset; i < row + kRowsAboutOffset; ++i)
      if (i != row) largest = std::max(largest, std::abs(sudden_change(values, i)));
    if (!(size > kFarLarger * largest) || !is_even_about(data.time_s, row, step_s)) continue;
    if (stands_still(values, row - kRowsAboutOffset) || stands_still(values, row)) continue;  // stuck before, or behind
    const LocalJump jump = local_jump(values, row);
    if (!(std::abs(jump.size) > kFarLarger * jump.residual)) continue;
    bool is_alone = true;
    for (std::size_t k = 0; k < data.columns.size() && is_alone; ++k)
      is_alone = data.columns[k].name == column.name || !changes_suddenly_about(data.columns[k], row, usual[k]);
    if (is_alone) jumps.push_back({row, jump.size});
    if (jumps.size() > kMostOffsets) return {};
  }
  return jumps;
}

}  // namespace

std::shared_ptr<const Series> without_sensor_jumps(const std::shared_ptr<const Series>& data) {
  const std::vector<RowRange> runs = runs_of(data->time_s);
  std::shared_ptr<Series> result;
  for (std::size_t run = 0; run < runs.size(); ++run) {
    const Series alone = runs.size() > 1 ? rows_of(*data, runs[run]) : Series();
    const Series& of = runs.size() > 1 ? alone : *data;
    std::vector<std::optional<double>> usual(of.columns.size());
    for (std::size_t k = 0; k < of.columns.size(); ++k) {
      for (const Jump& jump : jumps_of(of, of.columns[k], usual)) {
        if (!result) result = std::make_shared<Series>(*data);
        Column& column = result->columns[k];
        const std::size_t first = runs[run].begin + jump.row;
        for (std::size_t row = first; row < runs[run].end; ++row) column.values[row] -= jump.size;
        result->sensor_jumps.push_back(
            {column.name, run < data->runs.size() ? data->runs[run].name : "", data->time_s[first], jump.size});
      }
    }
  }
  return result ? result : data;
}

}  // namespace ballbar
