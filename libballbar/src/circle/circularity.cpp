#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "ballbar/circle/circle.hpp"
#include "ballbar/error.hpp"
#include "ballbar/units.hpp"

namespace ballbar {
namespace {

double in_turn_rad(double angle_rad) {
  const double turn = std::fmod(angle_rad, 2.0 * kPi);
  return turn < 0.0 ? turn + 2.0 * kPi : turn;
}

double in_turn_deg(double angle_rad) {
  const double angle_deg = deg_from_rad(in_turn_rad(angle_rad));
  return angle_deg >= 360.0 ? 0.0 : angle_deg;
}

// Standard deviation of a reading from one to the next: differences of neighbours, over sqrt 2.
double short_term_sigma_um(const Eigen::ArrayXd& deviation_um) {
  const Eigen::Index n = deviation_um.size();
  if (n < 2) return 0.0;
  return std::sqrt((deviation_um.tail(n - 1) - deviation_um.head(n - 1)).square().mean() / 2.0);
}

// Lengths of a recording by angle within one turn, for interpolation.
std::vector<std::pair<double, double>> by_angle(const Recording& recording) {
  std::vector<std::pair<double, double>> points(recording.length_mm.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i] = {in_turn_rad(recording.angle_rad[i]), recording.length_mm[i]};
  }
  std::sort(points.begin(), points.end());
  return points;
}

// Length at that angle between its neighbours on the circle; NaN where they are more than widest_rad apart.
double length_at(const std::vector<std::pair<double, double>>& points, double angle_rad, double widest_rad) {
  const auto above = std::lower_bound(points.begin(), points.end(), std::pair{angle_rad, 0.0});
  const auto& high = above == points.end() ? points.front() : *above;
  const auto& low = above == points.begin() ? points.back() : *std::prev(above);
  const double width_rad = in_turn_rad(high.first - low.first);
  const double part_rad = in_turn_rad(angle_rad - low.first);
  if (in_turn_rad(high.first - angle_rad) == 0.0) return high.second;
  if (width_rad > widest_rad) return std::nan("");
  return width_rad == 0.0 ? low.second : low.second + (high.second - low.second) * part_rad / width_rad;
}

void hysteresis(const Recording& ccw, const Recording& cw, Bidirectional& result) {
  const auto points = by_angle(cw);
  const double spacing_rad = arc_rad(cw) / static_cast<double>(points.size());
  double largest_mm = -1.0;
  for (std::size_t i = 0; i < ccw.length_mm.size(); ++i) {
    const double other_mm = length_at(points, in_turn_rad(ccw.angle_rad[i]), 3.0 * spacing_rad);
    const double apart_mm = std::abs(ccw.length_mm[i] - other_mm);
    if (apart_mm > largest_mm) {
      largest_mm = apart_mm;
      result.hysteresis_at_deg = in_turn_deg(ccw.angle_rad[i]);
    }
  }
  if (largest_mm < 0.0)
    throw Error("the CCW and the CW recording have no angle in common; expected the same arc both ways");
  result.hysteresis_um = um_from_mm(largest_mm);
}

}  // namespace

Circularity circularity(const Recording& recording, const Circle& circle) {
  const Eigen::ArrayXd radius_mm = radii_mm(recording, circle);
  const Eigen::ArrayXd deviation_um = (radius_mm - circle.radius_mm) * 1e3;
  Eigen::Index at_max = 0;
  Eigen::Index at_min = 0;
  Circularity result;
  result.max_circular_um = deviation_um.maxCoeff(&at_max);
  result.min_circular_um = deviation_um.minCoeff(&at_min);
  result.circular_deviation_um = result.max_circular_um - result.min_circular_um;
  const double max_rad = recording.angle_rad[static_cast<std::size_t>(at_max)];
  const double min_rad = recording.angle_rad[static_cast<std::size_t>(at_min)];
  result.max_at_deg = in_turn_deg(max_rad);
  result.min_at_deg = in_turn_deg(min_rad);
  const double growth_um = um_from_mm(circle.radius_mm - recording.nominal_length_mm);
  result.max_radial_um = result.max_circular_um + growth_um;
  result.min_radial_um = result.min_circular_um + growth_um;
  // G = r_max - r_min moves with the centre by -(u_max - u_min).c; R cancels.
  const Eigen::Vector2d lever(std::cos(max_rad) - std::cos(min_rad), std::sin(max_rad) - std::sin(min_rad));
  const double noise_um = short_term_sigma_um(deviation_um);
  result.circular_deviation_sigma_um =
      std::sqrt(lever.dot(circle.covariance_um2.topLeftCorner<2, 2>() * lever) + 2.0 * noise_um * noise_um);
  return result;
}

bool are_both_directions(const Recording& first, const Recording& second) {
  return first.direction != second.direction && first.plane == second.plane && first.motion == second.motion &&
         first.nominal_length_mm == second.nominal_length_mm;
}

Bidirectional bidirectional(const Recording& first, const Circle& first_circle, const Recording& second,
                            const Circle& second_circle) {
  if (first.direction == second.direction) {
    throw Error(fmt::format("both recordings are {}; ISO 230-4 needs one CCW and one CW", name_of(first.direction)));
  }
  if (first.plane != second.plane) {
    throw Error(fmt::format("one recording lies in plane {}, the other in {}; ISO 230-4 needs both in one plane",
                            name_of(first.plane), name_of(second.plane)));
  }
  Bidirectional result;
  const auto mean_centred = [&](const Recording& recording, Circle circle) {
    circle.centre_a_um = 0.5 * (first_circle.centre_a_um + second_circle.centre_a_um);
    circle.centre_b_um = 0.5 * (first_circle.centre_b_um + second_circle.centre_b_um);
    return radii_mm(recording, circle);
  };
  const Eigen::ArrayXd r1 = mean_centred(first, first_circle);
  const Eigen::ArrayXd r2 = mean_centred(second, second_circle);
  result.bidirectional_2005_um =
      um_from_mm(std::max(r1.maxCoeff(), r2.maxCoeff()) - std::min(r1.minCoeff(), r2.minCoeff()));
  result.bidirectional_1996_um = std::max(circularity(first, first_circle).circular_deviation_um,
                                          circularity(second, second_circle).circular_deviation_um);
  result.mean_radial_um = um_from_mm(0.5 * (first_circle.radius_mm + second_circle.radius_mm) -
                                     0.5 * (first.nominal_length_mm + second.nominal_length_mm));
  const bool first_is_ccw = first.direction == Direction::CCW;
  hysteresis(first_is_ccw ? first : second, first_is_ccw ? second : first, result);
  return result;
}

}  // namespace ballbar
