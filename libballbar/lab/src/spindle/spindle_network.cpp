#include "spindle/spindle_network.hpp"

#include <algorithm>
#include <cmath>

#include "ballbar/units.hpp"

namespace ballbar::thermal {
namespace {

using Eigen::Index;

constexpr double kWaterHeat_J_per_kg_K = 4186.0;
constexpr double kKelvin = 273.15;

double m(double length_mm) { return length_mm / 1e3; }
double square(double value) { return value * value; }

// Circle's sections in m2.
double shaft_m2(const FiniteVolumeSpindle& s) {
  return kPi * (square(m(s.shaft_radius_mm)) - square(m(s.bore_radius_mm)));
}
double tool_m2(const FiniteVolumeSpindle& s) { return kPi * square(m(s.tool_radius_mm)); }
double housing_side_m2(const FiniteVolumeSpindle& s) {
  return kPi * (square(m(s.housing_outer_mm)) - square(m(s.housing_inner_mm))) / 4.0;
}

Interval before_nose(const FiniteVolumeSpindle& s) { return {0.0, s.nose_mm}; }
Interval beyond_nose(const FiniteVolumeSpindle& s) { return {s.nose_mm, s.length_mm}; }

// Builds up a network; each function is one path of heat.
struct Builder {
  const FiniteVolumeSpindle& s;
  const Mechanisms& on;
  const Cells& cells;
  double speed_rpm;
  Network network;

  void link(Index a, Index b, double W_per_K) {
    if (W_per_K > 0.0) network.links.push_back({a, b, W_per_K});
  }
  void outlet(Index node, Index surroundings, double W_per_K) {
    if (W_per_K > 0.0) network.outlets.push_back({node, surroundings, W_per_K});
  }
  Shares shares(Side side, double excess) const { return more_to(side, on.asymmetry ? excess : 0.0); }
  double air(double still, double turning) const {
    return convection_W_per_m2_K(still, turning, on.convection ? speed_rpm : 0.0);
  }

  void store() {
    Eigen::VectorXd& capacity = network.capacity_J_per_K;
    capacity.resize(cells.nodes());
    const double steel_J_per_m3_K = s.density_kg_per_m3 * s.specific_heat_J_per_kg_K;
    for (std::size_t i = 0; i < cells.shaft.size(); ++i) {
      capacity[cells.shaft_node(i)] = steel_J_per_m3_K * (shaft_m2(s) * m(overlap_mm(cells.shaft[i], before_nose(s))) +
                                                          tool_m2(s) * m(overlap_mm(cells.shaft[i], beyond_nose(s))));
    }
    for (std::size_t j = 0; j < cells.housing.size(); ++j) {
      for (std::size_t side = 0; side < 4; ++side) {
        capacity[cells.housing_node(j, side)] = steel_J_per_m3_K * housing_side_m2(s) * m(cells.housing[j].length_mm());
      }
    }
    capacity[cells.rear_bearing()] = s.rear_rows * s.bearing_mass_kg * s.specific_heat_J_per_kg_K;
    capacity[cells.front_bearing()] = s.front_rows * s.bearing_mass_kg * s.specific_heat_J_per_kg_K;
    capacity[cells.jacket_water()] = s.jacket_water_kg * kWaterHeat_J_per_kg_K;
    capacity[cells.tank()] = s.tank_kg * kWaterHeat_J_per_kg_K;
    capacity[cells.head()] = s.head_kg * s.structure_heat_J_per_kg_K;
    capacity[cells.column_front()] = s.column_kg * s.structure_heat_J_per_kg_K;
    capacity[cells.column_back()] = s.column_kg * s.structure_heat_J_per_kg_K;
  }

  // From middle to middle: sum of dx / (k A).
  void along_shaft() {
    for (std::size_t i = 1; i < cells.shaft.size(); ++i) {
      const Interval path{cells.shaft[i - 1].middle_mm(), cells.shaft[i].middle_mm()};
      const double K_per_W =
          (m(overlap_mm(path, before_nose(s))) / shaft_m2(s) + m(overlap_mm(path, beyond_nose(s))) / tool_m2(s)) /
          s.conductivity_W_per_m_K;
      link(cells.shaft_node(i - 1), cells.shaft_node(i), 1.0 / K_per_W);
    }
  }

  void in_housing() {
    const double wall_m = m(s.housing_outer_mm - s.housing_inner_mm);
    const double quarter_m = m(s.housing_outer_mm + s.housing_inner_mm) / 2.0 * kPi / 2.0;
    for (std::size_t j = 0; j < cells.housing.size(); ++j) {
      const double cell_m = m(cells.housing[j].length_mm());
      for (std::size_t side = 0; side < 4; ++side) {
        link(cells.housing_node(j, side), cells.housing_node(j, (side + 1) % 4),
             s.conductivity_W_per_m_K * wall_m * cell_m / quarter_m);
        if (j == 0) continue;
        link(cells.housing_node(j - 1, side), cells.housing_node(j, side),
             s.conductivity_W_per_m_K * housing_side_m2(s) / cell_m);
      }
    }
  }

  void across_gap() {
    const double h = air(s.gap_still_W_per_m2_K, s.gap_turning_W_per_m2_K);
    for (std::size_t i = 0; i < cells.shaft.size(); ++i) {
      for (std::size_t j = 0; j < cells.housing.size(); ++j) {
        const double both_mm = overlap_mm(common(cells.shaft[i], cells.housing[j]), cells.motor);
        const double side_m2 = 2.0 * kPi * m(s.shaft_radius_mm) * m(both_mm) / 4.0;
        for (std::size_t side = 0; side < 4; ++side) {
          link(cells.shaft_node(i), cells.housing_node(j, side), h * side_m2);
        }
      }
    }
  }

  // A conductance between a body and the housing along an interval.
  void to_housing(Index body, const Interval& along, double W_per_K, const Shares& share) {
    for (std::size_t j = 0; j < cells.housing.size(); ++j) {
      const double part = overlap_mm(cells.housing[j], along) / along.length_mm();
      for (std::size_t side = 0; side < 4; ++side) {
        link(body, cells.housing_node(j, side), W_per_K * part * share[side]);
      }
    }
  }

  void bearing(Index body, const Interval& along, double rows) {
    to_housing(body, along, rows * s.outer_ring_W_per_K, more_to(plus_x, 0.0));
    for (std::size_t i = 0; i < cells.shaft.size(); ++i) {
      const double part = overlap_mm(cells.shaft[i], along) / along.length_mm();
      link(body, cells.shaft_node(i), rows * s.inner_ring_W_per_K * part);
    }
  }

  void surfaces() {
    const double h_shaft = air(s.shaft_still_W_per_m2_K, s.shaft_turning_W_per_m2_K);
    for (std::size_t i = 0; i < cells.shaft.size(); ++i) {
      const double nose_m = m(overlap_mm(cells.shaft[i], {s.housing_mm, s.nose_mm}));
      const double tool_m = m(overlap_mm(cells.shaft[i], beyond_nose(s)));
      const double surface_m2 = 2.0 * kPi * (m(s.shaft_radius_mm) * nose_m + m(s.tool_radius_mm) * tool_m);
      outlet(cells.shaft_node(i), room, h_shaft * surface_m2);
    }
    const double h_housing = air(s.housing_still_W_per_m2_K, s.housing_turning_W_per_m2_K);
    for (std::size_t j = 0; j < cells.housing.size(); ++j) {
      const double side_m2 = 2.0 * kPi * m(s.housing_outer_mm) * m(cells.housing[j].length_mm()) / 4.0;
      for (std::size_t side = 0; side < 4; ++side) outlet(cells.housing_node(j, side), room, h_housing * side_m2);
    }
  }

  void coolant() {
    if (on.coolant) {
      to_housing(cells.jacket_water(), cells.jacket, s.jacket_W_per_K, shares(plus_x, s.coolant_to_plus_x));
    }
    link(cells.jacket_water(), cells.tank(), s.flow_W_per_K);
    outlet(cells.tank(), room, s.tank_room_W_per_K);
    if (!on.thermostat) outlet(cells.tank(), set_point, s.chiller_W_per_K);
  }

  void structure() {
    to_housing(cells.head(), cells.flange, s.flange_W_per_K, shares(minus_y, s.flange_to_minus_y));
    link(cells.head(), cells.column_front(), s.head_column_W_per_K);
    link(cells.column_front(), cells.column_back(), s.column_front_back_W_per_K);
    outlet(cells.head(), room, s.head_room_W_per_K);
    outlet(cells.column_front(), room, s.column_room_W_per_K);
    outlet(cells.column_back(), room, s.column_room_W_per_K);
  }
};

}  // namespace

double convection_W_per_m2_K(double still, double turning, double speed_rpm) {
  return still + turning * std::pow(speed_rpm / 1e4, 0.7);
}

double viscosity_mm2_per_s(const FiniteVolumeSpindle& spindle, double oil_degC) {
  const auto twice_lg = [](double viscosity) { return std::log10(std::log10(viscosity + 0.7)); };
  const double lg_40 = std::log10(40.0 + kKelvin);
  const double lg_100 = std::log10(100.0 + kKelvin);
  const double at_40 = twice_lg(spindle.oil_at_40_degC_mm2_per_s);
  const double slope = (at_40 - twice_lg(spindle.oil_at_100_degC_mm2_per_s)) / (lg_100 - lg_40);  // B
  return std::pow(10.0, std::pow(10.0, at_40 - slope * (std::log10(oil_degC + kKelvin) - lg_40))) - 0.7;
}

double friction_W(const FiniteVolumeSpindle& spindle, double pitch_mm, double load_N, double speed_rpm,
                  double viscosity_mm2_per_s) {
  constexpr double kFloor = 160.0;  // where nu n < 2000 the lubricant's part no longer falls
  const double lubricant_N_mm = 1e-7 * spindle.f0 *
                                std::max(std::pow(viscosity_mm2_per_s * speed_rpm, 2.0 / 3.0), kFloor) *
                                std::pow(pitch_mm, 3);
  const double load_N_mm = spindle.f1 * load_N * pitch_mm;
  return 2.0 * kPi * speed_rpm / 60.0 * (lubricant_N_mm + load_N_mm) / 1e3;
}

Network network_of(const FiniteVolumeSpindle& spindle, const Mechanisms& mechanisms, const Cells& cells,
                   double speed_rpm) {
  Builder builder{spindle, mechanisms, cells, speed_rpm, {}};
  builder.store();
  builder.along_shaft();
  builder.in_housing();
  builder.across_gap();
  builder.bearing(cells.rear_bearing(), cells.rear, spindle.rear_rows);
  builder.bearing(cells.front_bearing(), cells.front, spindle.front_rows);
  builder.surfaces();
  builder.coolant();
  builder.structure();
  return builder.network;
}

Heat sources_of(const FiniteVolumeSpindle& spindle, const Mechanisms& mechanisms, const Cells& cells, double speed_rpm,
                double load_W) {
  const double per_10000 = speed_rpm / 1e4;
  const double loss_W =
      spindle.motor_loss_W * per_10000 + spindle.motor_windage_W * square(per_10000) + spindle.load_loss_share * load_W;
  Eigen::VectorXd steady_W = Eigen::VectorXd::Zero(cells.nodes());
  for (std::size_t i = 0; i < cells.shaft.size(); ++i) {
    steady_W[cells.shaft_node(i)] =
        spindle.rotor_share * loss_W * overlap_mm(cells.shaft[i], cells.motor) / cells.motor.length_mm();
  }
  const Shares share = more_to(plus_x, mechanisms.asymmetry ? spindle.stator_to_plus_x : 0.0);
  for (std::size_t j = 0; j < cells.housing.size(); ++j) {
    const double part = overlap_mm(cells.housing[j], cells.motor) / cells.motor.length_mm();
    for (std::size_t side = 0; side < 4; ++side) {
      steady_W[cells.housing_node(j, side)] = (1.0 - spindle.rotor_share) * loss_W * part * share[side];
    }
  }
  steady_W[cells.tank()] = spindle.pump_W;

  const Index rear = cells.rear_bearing();
  const Index front = cells.front_bearing();
  return [=, viscous = mechanisms.viscosity](const Eigen::VectorXd& temperature_degC) {
    const auto of_rows_W = [&](Index node, double rows, double pitch_mm) {
      const double viscosity =
          viscous ? viscosity_mm2_per_s(spindle, temperature_degC[node]) : spindle.oil_at_40_degC_mm2_per_s;
      return rows * friction_W(spindle, pitch_mm, spindle.bearing_load_N / rows, speed_rpm, viscosity);
    };
    Eigen::VectorXd heat_W = steady_W;
    heat_W[rear] += of_rows_W(rear, spindle.rear_rows, spindle.rear_pitch_mm);
    heat_W[front] += of_rows_W(front, spindle.front_rows, spindle.front_pitch_mm);
    return heat_W;
  };
}

}  // namespace ballbar::thermal
