// Where the spindle's tip goes: sums over the temperatures of the cells, one a cause.
#pragma once

#include <Eigen/Core>
#include <array>
#include <string_view>

#include "ballbar/lab/spindle/finite_volume_spindle.hpp"
#include "spindle/spindle_cells.hpp"

namespace ballbar::thermal {

inline constexpr std::array<std::string_view, 8> kCauses{"x_bending_um",     "y_bending_um",  "y_structure_um",
                                                         "z_shaft_um",       "z_housing_um",  "z_rings_um",
                                                         "z_centrifugal_um", "z_structure_um"};
enum Cause : Eigen::Index {
  x_bending,
  y_bending,
  y_structure,
  z_shaft,
  z_housing,
  z_rings,
  z_centrifugal,
  z_structure
};

// Causes by nodes: um of each cause for a kelvin of each node. z_centrifugal has no temperature.
Eigen::MatrixXd tip_um_per_K(const FiniteVolumeSpindle& spindle, const Mechanisms& mechanisms, const Cells& cells);

// Growth of the inner ring, n rpm, w = 2 pi n / 60, over tan(contact angle): the shaft as a disc with a hole, a < r < b
//   u = rho w^2 b / (4 E) ((1 - nu_P) b^2 + (3 + nu_P) a^2)
// less the contraction of the shaft from the front bearing to the nose, nu_P rho w^2 (a^2 + b^2) / (2 E) L, and
// ball_shift_um. The tool is too thin to count.
double centrifugal_um(const FiniteVolumeSpindle& spindle, double speed_rpm);

// Axial shift of the rotor, not above 0, as balls are thrown outwards. A ball of mass m runs at w_c = w / 2 (1 - D cos
// a / d), F = m d / 2 w_c^2; it presses on the outer groove at a_o and on the inner at a_i, each with the axial force P
// / Z of the springs. Contacts are rigid, the grooves' centres (f - 1/2) D away from the ball's:
//   cot a_o - cot a_i = F Z / P       cos a_o + cos a_i = 2 cos a       shift = (f - 1/2) D (sin a_o + sin a_i - 2 sin
//   a)
double ball_shift_um(const FiniteVolumeSpindle& spindle, double speed_rpm);

}  // namespace ballbar::thermal
