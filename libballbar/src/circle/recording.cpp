#include "ballbar/circle/recording.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "ballbar/units.hpp"

namespace ballbar {
namespace {

// Whether every step goes the same way and none is longer than 1.5 mean steps: the usual recording, whose only wider
// gap is from its end round to its start.
bool sweeps_evenly(const std::vector<double>& angle_rad) {
  const double mean_rad = (angle_rad.back() - angle_rad.front()) / static_cast<double>(angle_rad.size() - 1);
  bool evenly = mean_rad != 0.0;
  const double longest = 1.5 * std::abs(mean_rad);
  const double sign = mean_rad < 0.0 ? -1.0 : 1.0;
  for (std::size_t i = 1; i < angle_rad.size(); ++i) {
    const double step_rad = sign * (angle_rad[i] - angle_rad[i - 1]);
    evenly &= (step_rad >= 0.0) & (step_rad <= longest);
  }
  return evenly;
}

// Largest gap between neighbours on the circle. Of n readings the largest gap is at least 2 pi / n, so it
// never lies within one of n equal bins: the extremes of each bin are enough, and nothing is sorted. With more
// than kMostBins readings only gaps wider than a bin, 0.05 deg, matter.
constexpr std::size_t kMostBins = 7200;

double largest_gap_rad(const std::vector<double>& angle_rad) {
  const std::size_t n = std::min(angle_rad.size(), kMostBins);
  const double width_rad = 2.0 * kPi / static_cast<double>(n);
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  std::vector<double> lowest(n, kInfinity);
  std::vector<double> highest(n, -kInfinity);
  for (const double angle : angle_rad) {
    const double wrapped = std::max(0.0, angle - 2.0 * kPi * std::floor(angle / (2.0 * kPi)));
    const std::size_t bin = std::min(static_cast<std::size_t>(wrapped / width_rad), n - 1);
    lowest[bin] = std::min(lowest[bin], wrapped);
    highest[bin] = std::max(highest[bin], wrapped);
  }
  double first = kInfinity;
  double last = -kInfinity;
  double gap = 0.0;
  for (std::size_t bin = 0; bin < n; ++bin) {
    if (highest[bin] < lowest[bin]) continue;
    if (last >= 0.0) gap = std::max(gap, lowest[bin] - last);
    first = std::min(first, lowest[bin]);
    last = highest[bin];
  }
  return std::max(gap, first + 2.0 * kPi - last);
}

}  // namespace

std::array<int, 2> axes_of(Plane plane) {
  constexpr std::array<std::array<int, 2>, kPlanes.size()> kAxes{{{0, 1}, {1, 2}, {2, 0}, {1, 0}, {2, 1}, {0, 2}}};
  return kAxes[static_cast<std::size_t>(plane)];
}

double arc_rad(const Recording& recording) {
  const auto n = static_cast<double>(recording.angle_rad.size());
  if (recording.angle_rad.size() < 2) return 0.0;
  const double gap_rad =
      sweeps_evenly(recording.angle_rad)
          ? std::max(2.0 * kPi / n, 2.0 * kPi - std::abs(recording.angle_rad.back() - recording.angle_rad.front()))
          : largest_gap_rad(recording.angle_rad);
  if (gap_rad <= 1.5 * 2.0 * kPi / n) return 2.0 * kPi;
  // n readings at mid-sample span n - 1 of the arc's n shares.
  return std::min(2.0 * kPi, (2.0 * kPi - gap_rad) * n / (n - 1.0));
}

bool same_angles(const Recording& first, const Recording& second) {
  const std::size_t n = first.angle_rad.size();
  if (n == 0 || second.angle_rad.size() != n) return false;
  const double half_spacing_rad = 0.5 * arc_rad(first) / static_cast<double>(n);
  for (std::size_t i = 0; i < n; ++i) {
    if (std::abs(first.angle_rad[i] - second.angle_rad[i]) > half_spacing_rad) return false;
  }
  return true;
}

std::string_view name_of(Kind kind) { return kind == Kind::circle ? "circle" : "axial"; }

std::string_view name_of(Motion motion) {
  constexpr std::array<std::string_view, 3> kNames{"linear_axes", "rotary_axis", "spindle"};
  return kNames[static_cast<std::size_t>(motion)];
}

std::string_view name_of(Plane plane) {
  constexpr std::array<std::string_view, kPlanes.size()> kNames{"XY", "YZ", "ZX", "YX", "ZY", "XZ"};
  return kNames[static_cast<std::size_t>(plane)];
}

std::string_view name_of(MovingBall moving_ball) { return moving_ball == MovingBall::spindle ? "spindle" : "table"; }

std::string_view name_of(Direction direction) { return direction == Direction::CCW ? "CCW" : "CW"; }

}  // namespace ballbar
