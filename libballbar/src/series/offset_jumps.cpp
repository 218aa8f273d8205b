#include "series/offset_jumps.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "ballbar/internal/numerics/order_statistic.hpp"
#include "series/resolution.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kRowsAboutOffset = 8, kRowsOfTrend = 4, kMostOffsets = 2;
constexpr double kFarLarger = 5.0, kResolutions = 5.0;

// The jump between two parabolas of one slope and one bend, and the rms of what they leave.
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

}  // namespace

std::vector<OffsetJump> offset_jumps(const std::vector<double>& values) {
  std::vector<OffsetJump> jumps;
  std::vector<double> changes(values.size(), 0.0);
  for (std::size_t i = 1; i < values.size(); ++i) changes[i] = values[i] - values[i - 1];
  changes = less_running_median(changes, kRowsOfTrend);
  const double least = kResolutions * resolution_of(values);
  for (std::size_t row = kRowsAboutOffset; row + kRowsAboutOffset <= values.size(); ++row) {
    const double size = std::abs(changes[row]);
    if (!(size > least)) continue;
    double largest = 0.0;
    for (std::size_t i = row + 1 - kRowsAboutOffset; i < row + kRowsAboutOffset; ++i)
      if (i != row) largest = std::max(largest, std::abs(changes[i]));
    if (!(size > kFarLarger * largest)) continue;
    const LocalJump jump = local_jump(values, row);
    if (std::abs(jump.size) > kFarLarger * jump.residual) jumps.push_back({row, jump.size});
  }
  return jumps.size() > kMostOffsets ? std::vector<OffsetJump>{} : jumps;
}

}  // namespace ballbar
