// The finite-volume spindle as a network of heat: capacities, conductances and sources at one speed.
#pragma once

#include "ballbar/lab/spindle/finite_volume_spindle.hpp"
#include "spindle/spindle_cells.hpp"
#include "spindle/thermal_network.hpp"

namespace ballbar::thermal {

// Surroundings of the network, in this order.
enum Surroundings : Eigen::Index { room, set_point };

Network network_of(const FiniteVolumeSpindle& spindle, const Mechanisms& mechanisms, const Cells& cells,
                   double speed_rpm);

// Motor, bearings and pump. The chiller that switches is not in it.
Heat sources_of(const FiniteVolumeSpindle& spindle, const Mechanisms& mechanisms, const Cells& cells, double speed_rpm,
                double load_W);

// Walther: lg lg (nu + 0.7) = A - B lg T, T in K, through the oil's two points.
double viscosity_mm2_per_s(const FiniteVolumeSpindle& spindle, double oil_degC);

// Of one row; the formula is in finite_volume_spindle.hpp.
double friction_W(const FiniteVolumeSpindle& spindle, double pitch_mm, double load_N, double speed_rpm,
                  double viscosity_mm2_per_s);

// still + turning N^0.7, N = n / 10 000 rpm
double convection_W_per_m2_K(double still, double turning, double speed_rpm);

}  // namespace ballbar::thermal
