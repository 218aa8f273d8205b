// Thermal error of a motorized spindle after Huang, Li, Zhao 2022: axial growth from one temperature, growth of the
// bearing's rings from their temperature over the radius, and the radial clearance that axial growth opens.
//
//   eq. 21      dL  = alpha L (T(xi) - T0)                            xi the mean-value point
//   eq. 14      u_r = (alpha / r) ((1 + mu) I(a, r) + ((1 - mu) r^2 + (1 + mu) a^2) / (b^2 - a^2) I(a, b))
//   eq. 15      u_B = 2 alpha r_B / (r_B^2 - r_A^2) I(A, B)           eq. 14 at the outer edge of the inner ring
//   eq. 17      u_C = 2 alpha r_C / (r_D^2 - r_C^2) I(C, D)           eq. 14 at the inner edge of the outer ring
//   eq. 18      E   = u_C - u_B + c
//   eq. 29-32   alpha' = arcsin(sin 18 deg - 0.8 dL / (D_w (f - 0.5))),  theta = (180 deg - (18 deg - alpha')) / 2 - 72
//   deg,
//               c   = 0.8 dL tan theta
//
// with I(p, q) = integral of T r dr from p to q, T the rise above the start, and mu Poisson's ratio, which drops out at
// both edges. A ring of one temperature has I(a, r) = T (r^2 - a^2) / 2, so eq. 14 becomes u_r = alpha r T.
//
// Accuracy against the paper. Table 1, model of dL: 16 of 17 rows to the printed digit; the row at 30.7 degC prints
// 18.50 um where eq. 21 gives 18.40. Table 2, clearance: its values do not follow from eq. 29 to 32; at dL = 20.20 um
// they give 4.77 um where it prints 5.14, and the largest difference is 0.81 um, at dL = 9.65 um. Poisson's ratio and
// r_D of eq. 17 need a measured temperature over the radius, which the paper does not give.
//
// Source: Huang, Li, Zhao 2022, doi 10.19650/j.cnki.cjsi.J2209226, sections 2 to 4, tables 1 and 2.
#pragma once

#include <span>

namespace ballbar {

// Spindle and bearing (7010) of the paper, section 4.2.
struct Huang2022 {
  double expansion_ppm_per_K = 13.6;  // alpha
  double length_mm = 165.0;           // L
  double start_degC = 22.5;           // T0
  double inner_ring_bore_mm = 25.0;   // r_A
  double inner_raceway_mm = 27.34;    // r_B
  double outer_raceway_mm = 37.66;    // r_C
  double poisson_ratio = 0.26;        // mu
  double ball_diameter_mm = 10.319;   // D_w
  double groove_factor = 0.53;        // f
};

// Rise of the temperature above the start over a ring's radius: n >= 2 samples from inner to outer edge, radii rising
// and positive; a straight line between the samples, for which the integral is exact. Throws Error for anything else.
struct RingTemperature {
  std::span<const double> radius_mm;
  std::span<const double> rise_K;
};

// Eq. 21.
double mean_point_elongation_um(double expansion_ppm_per_K, double length_mm, double rise_K);

// Eq. 14: how far the circle of radius at_mm moves outwards. Throws Error where at_mm is not in the ring.
double ring_growth_um(const RingTemperature& ring, double at_mm, double expansion_ppm_per_K, double poisson_ratio);

// Eq. 15 and 17.
double inner_ring_growth_um(const RingTemperature& inner_ring, double expansion_ppm_per_K);  // u_B
double outer_ring_growth_um(const RingTemperature& outer_ring, double expansion_ppm_per_K);  // u_C

// Eq. 29 to 32: c of an elongation dL that unloads the bearing. Negative dL continues the formula. Throws Error where
// the arcsin has no value: for the paper's bearing below -267 um and above 506 um.
double clearance_um(double elongation_um, double ball_diameter_mm, double groove_factor);

// Eq. 18.
double radial_error_um(double outer_growth_um, double inner_growth_um, double c_um);

}  // namespace ballbar
