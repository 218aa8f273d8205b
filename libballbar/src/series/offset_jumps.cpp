#include "series/offset_jumps.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <utility>

#include "ballbar/internal/numerics/order_statistic.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kRowsAboutOffset = 8, kRowsOfTrend = 4, kMostOffsets = 2;
constexpr double kFarLarger = 5.0, kEven = 1.5;
constexpr std::size_t kBeforeOffset = 5, kBehindOffset = 2;  // rows in which another column changes with it

// The changes from row to row, each less the median of those about it. A gap has none.
std::vector<double> sudden_changes(const std::vector<double>& values) {
  std::vector<double> changes(values.size(), 0.0);
  for (std::size_t i = 1; i < values.size(); ++i) {
    const double change = values[i] - values[i - 1];
    if (std::isfinite(change)) changes[i] = change;
  }
  return less_running_median(changes, kRowsOfTrend);
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

bool changes_suddenly_about(const Column& other, std::size_t row) {
  const std::size_t first = row - kBeforeOffset, last = std::min(other.values.size() - 1, row + kBehindOffset);
  if (other.role == Role::speed || other.role == Role::load || other.role == Role::event) {
    for (std::size_t i = first; i <= last; ++i)
      if (other.values[i] != other.values[i - 1]) return true;
    return false;
  }
  const std::vector<double> changes = sudden_changes(other.values);
  std::vector<double> sizes = changes;
  for (double& one : sizes) one = std::abs(one);
  const double usual = std::max(median(std::move(sizes)), 0.5 * usual_change(other.values));
  return std::any_of(changes.begin() + static_cast<std::ptrdiff_t>(first),
                     changes.begin() + static_cast<std::ptrdiff_t>(last) + 1,
                     [&](double change) { return std::abs(change) > 2.0 * kFarLarger * usual; });
}

}  // namespace

std::vector<OffsetJump> offset_jumps(const Series& data, const Column& column) {
  const std::vector<double>& values = column.values;
  const std::vector<double> changes = sudden_changes(values);
  const double least = kFarLarger * usual_change(values), step_s = median_step_s(data.time_s);
  std::vector<OffsetJump> jumps;
  for (std::size_t row = kRowsAboutOffset; row + kRowsAboutOffset <= values.size(); ++row) {
    const double size = std::abs(changes[row]);
    if (!(size > least)) continue;
    double largest = 0.0;
    for (std::size_t i = row + 1 - kRowsAboutOffset; i < row + kRowsAboutOffset; ++i)
      if (i != row) largest = std::max(largest, std::abs(changes[i]));
    if (!(size > kFarLarger * largest) || !is_even_about(data.time_s, row, step_s)) continue;
    const LocalJump jump = local_jump(values, row);
    const bool is_alone = std::none_of(data.columns.begin(), data.columns.end(), [&](const Column& other) {
      return other.name != column.name && changes_suddenly_about(other, row);
    });
    if (std::abs(jump.size) > kFarLarger * jump.residual && is_alone) jumps.push_back({row, jump.size});
  }
  return jumps.size() > kMostOffsets ? std::vector<OffsetJump>{} : jumps;
}

}  // namespace ballbar
