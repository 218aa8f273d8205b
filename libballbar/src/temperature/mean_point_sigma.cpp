#include "ballbar/temperature/mean_point_sigma.hpp"

#include <algorithm>
#include <cmath>

namespace ballbar {
namespace {

constexpr double kSame = 2.0;  // sigma: crossings not farther apart than that in T are one

}  // namespace

double same_degC(const TemperatureProfile& profile, double level_degC) {
  const std::vector<MeanPoint> crossings = points_at(profile, level_degC);
  if (crossings.empty() || profile.sigma_degC.empty()) return 0.0;
  return kSame * sigma_at(profile, crossings.front().x_mm);
}

TemperatureProfile with_step(TemperatureProfile profile, double step_degC) {
  for (double& sigma : profile.sigma_degC) sigma = std::hypot(sigma, step_degC / std::sqrt(12.0));
  return profile;
}

std::vector<MeanPoint> flattest_first(std::vector<MeanPoint> points) {
  std::stable_sort(points.begin(), points.end(), [](const MeanPoint& a, const MeanPoint& b) {
    return std::abs(a.slope_degC_per_mm) < std::abs(b.slope_degC_per_mm);
  });
  return points;
}

double sigma_of_place_mm(const TemperatureProfile& profile, const MeanPoint& point, double edge_sigma_mm) {
  const double along = sigma_at(profile, point.x_mm) / std::abs(point.slope_degC_per_mm);
  return std::hypot(along, edge_sigma_mm, 0.5 * (point.to_mm - point.from_mm));
}

}  // namespace ballbar
