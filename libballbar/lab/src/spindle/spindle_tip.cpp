#include "spindle/spindle_tip.hpp"

#include <algorithm>
#include <cmath>

#include "ballbar/units.hpp"
#include "numerics/root.hpp"

namespace ballbar::thermal {
namespace {

constexpr double um(double ppm_mm) { return ppm_mm / 1e3; }  // 1 ppm of 1 mm is 1e-3 um

// Curvature of the tube for a kelvin between opposite sides, ppm/mm: a gradient g across the tube gives alpha g, and
// the means over quarters of the circumference differ by 2 g r sin(45 deg) / (pi / 4).
double curvature_ppm_per_mm_K(const FiniteVolumeSpindle& s) {
  const double radius_mm = (s.housing_inner_mm + s.housing_outer_mm) / 2.0;
  return s.expansion_ppm_per_K / (2.0 * radius_mm * std::sin(kPi / 4.0) / (kPi / 4.0));
}

// Deflection towards a side for curvature 1/mm away from it in one cell, mm2: the housing is clamped at the flange, and
// each piece ds at s turns what lies beyond it, so - (distance from s) ds.
double deflection_mm2(const Interval& cell, double flange_mm, double at_mm) {
  const Interval bent = common(cell, {std::min(flange_mm, at_mm), std::max(flange_mm, at_mm)});
  return -bent.length_mm() * std::abs(at_mm - bent.middle_mm());
}

// Of the rotor's axis, a straight line through the two bearings, at the tip.
double tip_deflection_mm2(const FiniteVolumeSpindle& s, const Cells& cells, const Interval& cell) {
  const double rear_mm = cells.rear.middle_mm();
  const double front_mm = cells.front.middle_mm();
  const double at_rear = deflection_mm2(cell, s.flange_mm, rear_mm);
  const double at_front = deflection_mm2(cell, s.flange_mm, front_mm);
  return at_front + (at_front - at_rear) * (s.length_mm - front_mm) / (front_mm - rear_mm);
}

}  // namespace

Eigen::MatrixXd tip_um_per_K(const FiniteVolumeSpindle& spindle, const Mechanisms& mechanisms, const Cells& cells) {
  const FiniteVolumeSpindle& s = spindle;
  Eigen::MatrixXd tip = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(kCauses.size()), cells.nodes());
  const double tan_contact = std::tan(rad_from_deg(s.contact_angle_deg));
  const double inner_mm = (s.front_pitch_mm - s.ball_mm) / 2.0;
  const double outer_mm = (s.front_pitch_mm + s.ball_mm) / 2.0;
  const double rings = mechanisms.rings ? s.expansion_ppm_per_K / tan_contact : 0.0;
  const double front_mm = cells.front.middle_mm();

  for (std::size_t i = 0; i < cells.shaft.size(); ++i) {
    const Eigen::Index node = cells.shaft_node(i);
    tip(z_shaft, node) = um(s.expansion_ppm_per_K * overlap_mm(cells.shaft[i], {front_mm, s.length_mm}));
    tip(z_rings, node) = um(rings * inner_mm * overlap_mm(cells.shaft[i], cells.front) / cells.front.length_mm());
  }
  tip(z_rings, cells.front_bearing()) = um(rings * s.ball_mm);
  const Interval forward{std::min(s.flange_mm, front_mm), std::max(s.flange_mm, front_mm)};
  const double sign = front_mm > s.flange_mm ? 1.0 : -1.0;
  for (std::size_t j = 0; j < cells.housing.size(); ++j) {
    const Interval& cell = cells.housing[j];
    const double bending = um(curvature_ppm_per_mm_K(s) * tip_deflection_mm2(s, cells, cell));
    tip(x_bending, cells.housing_node(j, plus_x)) = bending;
    tip(x_bending, cells.housing_node(j, minus_x)) = -bending;
    tip(y_bending, cells.housing_node(j, plus_y)) = bending;
    tip(y_bending, cells.housing_node(j, minus_y)) = -bending;
    for (std::size_t side = 0; side < 4; ++side) {
      const Eigen::Index node = cells.housing_node(j, side);
      tip(z_housing, node) = sign * um(s.expansion_ppm_per_K * overlap_mm(cell, forward)) / 4.0;
      tip(z_rings, node) = -um(rings * outer_mm * overlap_mm(cell, cells.front) / cells.front.length_mm()) / 4.0;
    }
  }
  if (!mechanisms.structure) return tip;

  const double alpha = s.structure_expansion_ppm_per_K;
  const double bow_um_per_K = um(alpha * s.column_height_mm * s.column_height_mm / (2.0 * s.column_depth_mm));
  const double tilt_um_per_K = um(alpha * s.column_height_mm / s.column_depth_mm * s.overhang_mm);
  const double growth_um_per_K = um(alpha * s.column_height_mm) / 2.0;
  tip(y_structure, cells.head()) = um(alpha * s.overhang_mm);
  tip(y_structure, cells.column_front()) = -bow_um_per_K;
  tip(y_structure, cells.column_back()) = bow_um_per_K;
  tip(z_structure, cells.column_front()) = -growth_um_per_K - tilt_um_per_K;
  tip(z_structure, cells.column_back()) = -growth_um_per_K + tilt_um_per_K;
  return tip;
}

double centrifugal_um(const FiniteVolumeSpindle& spindle, double speed_rpm) {
  const double w = 2.0 * kPi * speed_rpm / 60.0;
  const double a = spindle.bore_radius_mm / 1e3;
  const double b = spindle.shaft_radius_mm / 1e3;
  const double nu = spindle.poisson;
  const double rho_w2_per_E = spindle.density_kg_per_m3 * w * w / (spindle.young_GPa * 1e9);  // 1/m2
  const double growth_m = rho_w2_per_E * b / 4.0 * ((1.0 - nu) * b * b + (3.0 + nu) * a * a);
  const double front_mm = (spindle.front_from_mm + spindle.front_to_mm) / 2.0;
  const double contraction_m = nu * rho_w2_per_E * (a * a + b * b) / 2.0 * (spindle.nose_mm - front_mm) / 1e3;
  return 1e6 * (growth_m / std::tan(rad_from_deg(spindle.contact_angle_deg)) - contraction_m) +
         ball_shift_um(spindle, speed_rpm);
}

double ball_shift_um(const FiniteVolumeSpindle& spindle, double speed_rpm) {
  const double angle_rad = rad_from_deg(spindle.contact_angle_deg);
  const double ball_m = spindle.ball_mm / 1e3;
  const double pitch_m = spindle.front_pitch_mm / 1e3;
  const double mass_kg = spindle.ball_density_kg_per_m3 * kPi / 6.0 * ball_m * ball_m * ball_m;
  const double orbit = kPi * speed_rpm / 60.0 * (1.0 - ball_m * std::cos(angle_rad) / pitch_m);
  const double pull_N = mass_kg * pitch_m / 2.0 * orbit * orbit;
  const double ratio = pull_N * spindle.balls * spindle.front_rows / spindle.bearing_load_N;

  // cot a_o - cot a_i rises from 0 as c = cos a_o rises from cos a to its limit, where a_i or a_o is at its end.
  const double level = std::cos(angle_rad);
  const auto sine = [](double cosine) { return std::sqrt(1.0 - cosine * cosine); };
  const auto is_below = [&](double outer) {
    const double inner = 2.0 * level - outer;
    return outer / sine(outer) - inner / sine(inner) < ratio;
  };
  const double outer = root_between(is_below, level, std::min(1.0, 2.0 * level)).first;
  const double sines = sine(outer) + sine(2.0 * level - outer);
  return 1e6 * (spindle.groove - 0.5) * ball_m * (sines - 2.0 * sine(level));
}

}  // namespace ballbar::thermal
