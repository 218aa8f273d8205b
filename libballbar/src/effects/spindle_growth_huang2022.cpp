#include "ballbar/effects/spindle_growth_huang2022.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "ballbar/error.hpp"
#include "effects/bearing_clearance_huang2022.hpp"

namespace ballbar {
namespace {

void check(const RingTemperature& ring) {
  const std::size_t n = ring.radius_mm.size();
  if (n < 2 || ring.rise_K.size() != n) {
    throw Error(fmt::format("a ring needs at least two radii and as many temperatures; there are {} and {}", n,
                            ring.rise_K.size()));
  }
  if (!(ring.radius_mm[0] > 0.0)) throw Error(fmt::format("a radius must be positive; found {} mm", ring.radius_mm[0]));
  for (std::size_t i = 1; i < n; ++i) {
    if (!(ring.radius_mm[i] > ring.radius_mm[i - 1])) {
      throw Error(fmt::format("the radii of a ring must rise; found {} mm after {} mm", ring.radius_mm[i],
                              ring.radius_mm[i - 1]));
    }
  }
}

// Integral of T r dr from the inner edge to at_mm, K mm^2. Between two samples T and r are straight lines:
// (q - p) (p (2 T_p + T_q) + q (T_p + 2 T_q)) / 6.
double integral_K_mm2(const RingTemperature& ring, double at_mm) {
  double sum = 0.0;
  for (std::size_t i = 1; i < ring.radius_mm.size() && ring.radius_mm[i - 1] < at_mm; ++i) {
    const double p = ring.radius_mm[i - 1], q = std::min(ring.radius_mm[i], at_mm);
    const double slope = (ring.rise_K[i] - ring.rise_K[i - 1]) / (ring.radius_mm[i] - p);
    const double at_p = ring.rise_K[i - 1], at_q = at_p + slope * (q - p);
    sum += (q - p) * (p * (2.0 * at_p + at_q) + q * (at_p + 2.0 * at_q)) / 6.0;
  }
  return sum;
}

// 2 alpha r I / (b^2 - a^2) at an edge r; mm times ppm is nm, hence 1e-3 to um.
double edge_growth_um(const RingTemperature& ring, double edge_mm, double expansion_ppm_per_K) {
  const double a = ring.radius_mm.front(), b = ring.radius_mm.back();
  return 1e-3 * expansion_ppm_per_K * 2.0 * edge_mm * integral_K_mm2(ring, b) / ((b - a) * (b + a));
}

}  // namespace

double mean_point_elongation_um(double expansion_ppm_per_K, double length_mm, double rise_K) {
  return 1e-3 * expansion_ppm_per_K * length_mm * rise_K;
}

double ring_growth_um(const RingTemperature& ring, double at_mm, double expansion_ppm_per_K, double poisson_ratio) {
  check(ring);
  const double a = ring.radius_mm.front(), b = ring.radius_mm.back(), r = at_mm, mu = poisson_ratio;
  if (!(r >= a && r <= b)) throw Error(fmt::format("a radius of {} mm is not in the ring from {} to {} mm", r, a, b));
  const double whole = ((1.0 - mu) * r * r + (1.0 + mu) * a * a) / ((b - a) * (b + a)) * integral_K_mm2(ring, b);
  return 1e-3 * expansion_ppm_per_K / r * ((1.0 + mu) * integral_K_mm2(ring, r) + whole);
}

double inner_ring_growth_um(const RingTemperature& inner_ring, double expansion_ppm_per_K) {
  check(inner_ring);
  return edge_growth_um(inner_ring, inner_ring.radius_mm.back(), expansion_ppm_per_K);
}

double outer_ring_growth_um(const RingTemperature& outer_ring, double expansion_ppm_per_K) {
  check(outer_ring);
  return edge_growth_um(outer_ring, outer_ring.radius_mm.front(), expansion_ppm_per_K);
}

double clearance_um(double elongation_um, double ball_diameter_mm, double groove_factor) {
  if (!(std::abs(huang2022_sine_of_contact(elongation_um, ball_diameter_mm, groove_factor)) <= 1.0)) {
    throw Error(fmt::format("no contact angle belongs to an elongation of {} um with balls of {} mm and f = {}",
                            elongation_um, ball_diameter_mm, groove_factor));
  }
  return huang2022_clearance_um(elongation_um, ball_diameter_mm, groove_factor);
}

double radial_error_um(double outer_growth_um, double inner_growth_um, double c_um) {
  return outer_growth_um - inner_growth_um + c_um;
}

}  // namespace ballbar
