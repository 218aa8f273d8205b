// A motor spindle made of finite volumes: temperatures, elongation and tilt of a spindle from its physics.
//
// It is the independent tier of the diagnosis: nothing of the catalogue of effects is in it, so that a model is not
// judged by itself. There are no low passes and no gains of an effect, only bodies, conductances and sources of heat.
//
//   shaft      cells along the axis, from the rear end (0) over the bearings, the motor and the nose to the ball
//              (length_mm); beyond nose_mm the tool or test bar
//   housing    cells along the axis, each of four sides +x, +y, -x, -y: a tube, clamped in the head at flange_mm
//   bearings   one node each, between shaft and housing. Friction of the lubricant and of the load, after Palmgren:
//                M = 1e-7 f0 max((nu n)^(2/3), 160) d^3 + f1 F d   N mm   H = 2 pi n / 60 M / 1000 W   a row
//              nu mm2/s, n rpm, d mm pitch, F N a row. The viscosity nu(T) falls as lg lg (nu + 0.7) is linear in lg T
//              (Walther, ASTM D341), between the two that are stated.
//   motor      loss = motor_loss_W N + motor_windage_W N^2 + load_loss_share load,  N = n / 10 000 rpm; in the rotor
//              (shaft) and the stator (housing)
//   air        every free surface gives heat to the room by h = still + turning N^0.7
//   coolant    a jacket round the motor, fed from a tank whose chiller a thermostat switches
//   structure  the head, which carries the housing over the column, and the column's front and back, which follow the
//              room in hours
//
// The tip is the ball at length_mm, relative to a table that stays; change since the start, at which the machine has
// stood for ever in the room's first temperature. x and y: machine frame, column on the side of -y, the motor's
// cables on the side of +x, the coolant's inlet on the side of -x. z: elongation, positive towards the table. By cause,
// alpha dT summed over the cells:
//   z_shaft        shaft and tool, from the middle of the front bearing, which locates it, to the ball
//   z_housing      housing from the flange to the middle of the front bearing
//   z_rings        (r_i T_i + d_b T_b - r_o T_o) alpha / tan(contact angle): rings and balls of the front bearing
//                  wedge the rotor forward against its springs
//   z_centrifugal  at once with the speed: the inner ring's growth by turning, u(n) / tan(contact angle); the balls
//                  thrown outwards, which lets the springs draw the rotor in; the shaft's contraction
//                  nu_P rho w^2 (a^2 + b^2) / (2 E) times its length
//   z_structure    - column's growth, - overhang times the column's tilt
//   x_bending, y_bending   a housing warmer on one side bends; its two bearings carry the rotor's axis along
//   y_structure    the head's growth away from the column, less the bow of a column warmer in front
// x_um = x_bending_um and so on: the causes add up to the position, to rounding.
//
// Left out: radial play (springs preload the bearings), preload by temperature differences, radiation, water that
// warms along the jacket, a table or bed that moves.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "ballbar/series/series.hpp"
#include "ballbar/temperature/temperature.hpp"

namespace ballbar {

// Positions along the axis in mm from the rear end; radii from the axis. Defaults: a spindle for 20 000 rpm, 65 mm
// bearings at the front, in a milling head.
struct FiniteVolumeSpindle {
  double cells = 52.0;  // of the shaft, a whole number; the housing's are as long
  double length_mm = 520.0;
  double nose_mm = 420.0;
  double housing_mm = 380.0;  // where the housing ends
  double flange_mm = 200.0, flange_width_mm = 40.0;
  double rear_from_mm = 40.0, rear_to_mm = 65.0;
  double motor_from_mm = 110.0, motor_to_mm = 270.0;
  double front_from_mm = 310.0, front_to_mm = 360.0;
  double jacket_from_mm = 100.0, jacket_to_mm = 300.0;
  double bore_radius_mm = 12.0, shaft_radius_mm = 32.0, tool_radius_mm = 16.0;
  double housing_inner_mm = 55.0, housing_outer_mm = 85.0;

  double density_kg_per_m3 = 7850.0;  // of shaft, housing and bearings: steel
  double specific_heat_J_per_kg_K = 470.0;
  double conductivity_W_per_m_K = 45.0;
  double expansion_ppm_per_K = 11.7;
  double young_GPa = 208.0;
  double poisson = 0.29;

  double front_rows = 2.0, rear_rows = 1.0;
  double front_pitch_mm = 82.0, rear_pitch_mm = 70.0;
  double ball_mm = 10.0;                                 // the races' radii are (pitch -+ ball) / 2
  double balls = 20.0, ball_density_kg_per_m3 = 3200.0;  // of a row; ceramic
  double groove = 0.52;                                  // radius of the grooves over the ball's diameter
  double contact_angle_deg = 25.0;
  double f0 = 0.45, f1 = 0.0003;     // oil and air; angular contact
  double bearing_load_N = 500.0;     // of the springs; the rows of a bearing share it
  double bearing_mass_kg = 0.3;      // balls, and what of the rings is not shaft or housing; a row
  double inner_ring_W_per_K = 12.0;  // from balls and oil to the shaft, a row
  double outer_ring_W_per_K = 14.0;  // to the housing
  double oil_at_40_degC_mm2_per_s = 22.0, oil_at_100_degC_mm2_per_s = 4.2;

  double motor_loss_W = 180.0, motor_windage_W = 140.0;  // at 10 000 rpm
  double load_loss_share = 0.12;
  double rotor_share = 0.25;  // of the motor's loss

  double shaft_still_W_per_m2_K = 9.0, shaft_turning_W_per_m2_K = 45.0;  // nose and tool to the room
  double gap_still_W_per_m2_K = 15.0, gap_turning_W_per_m2_K = 60.0;     // rotor to stator
  double housing_still_W_per_m2_K = 6.0, housing_turning_W_per_m2_K = 6.0;

  double jacket_W_per_K = 120.0;  // housing to the water in the jacket
  double jacket_water_kg = 2.0;
  double flow_W_per_K = 550.0;  // mass flow times specific heat: 8 l/min
  double tank_kg = 60.0;
  double tank_room_W_per_K = 8.0;
  double pump_W = 100.0;
  double chiller_W = 3000.0;  // while it is on
  double set_point_degC = 20.0;
  double hysteresis_K = 1.0;        // on above set point + half of it, off below set point - half
  double chiller_W_per_K = 2000.0;  // of the steady chiller that stands in where the thermostat is off

  // Where heat passes on one side more than on the opposite one: sides get (1 + a)/4, 1/4, (1 - a)/4, 1/4.
  double stator_to_plus_x = 0.5;
  double coolant_to_plus_x = -0.5;
  double flange_to_minus_y = 0.7;

  double flange_W_per_K = 70.0;
  double head_kg = 120.0, column_kg = 350.0;  // column: front and back each
  double structure_heat_J_per_kg_K = 500.0;
  double structure_expansion_ppm_per_K = 10.5;
  double head_column_W_per_K = 12.0, column_front_back_W_per_K = 8.0;
  double head_room_W_per_K = 10.0, column_room_W_per_K = 15.0;  // column: front and back each
  double overhang_mm = 300.0;                                   // column's front to the spindle
  double column_height_mm = 500.0, column_depth_mm = 400.0;
};

// What the physics may be told to leave out, so that an effect can be hidden or absent.
struct Mechanisms {
  bool viscosity = true;    // off: the oil's viscosity stays that of 40 degC
  bool convection = true;   // off: the air's h is the one of a standing spindle at any speed
  bool asymmetry = true;    // off: the four sides share alike; x and y_bending are 0
  bool rings = true;        // off: z_rings is 0
  bool centrifugal = true;  // off: z_centrifugal is 0
  bool thermostat = true;   // off: a steady chiller, chiller_W_per_K, instead of one that switches
  bool coolant = true;      // off: the jacket is dry
  bool room = true;         // off: the machine keeps the room's first temperature, though T_room_degC is what it is
  bool structure = true;    // off: head and column keep their shape
};

// Speed and load hold from their time to the next; the room is straight lines between its points, held beyond them.
struct DutyPlan {
  std::vector<double> time_s;     // rising, the first is the start
  std::vector<double> speed_rpm;  // >= 0, as many
  std::vector<double> load_W;     // >= 0, as many, or empty: none
  double end_s = 0.0;
  std::vector<double> room_time_s;  // rising
  std::vector<double> room_degC;    // as many; empty: 20 degC
};

struct ThermalClock {
  double interval_s = 15.0;       // of the rows
  double step_s = 15.0;           // longest step of the calculation; steps also end at every row and change of speed
  std::vector<double> profile_s;  // rising, from the start to the last row: when the shaft's temperature along the axis
                                  // is wanted; steps end there too
};

// Temperature along the shaft at one time.
struct ShaftProfile {
  double time_s = 0.0;
  TemperatureProfile shaft;  // x_mm: the middles of the shaft's cells from the rear end, as the positions above
};

struct HeatBalance {
  double source_J = 0.0;   // friction, motor, pump
  double stored_J = 0.0;   // sum of C (T - T at the start)
  double room_J = 0.0;     // given to the room
  double chiller_J = 0.0;  // taken by the chiller
};

// Rows from the start to the last interval that ends by end_s.
struct ThermalRun {
  Series
      sensors;   // speed_rpm, load_W, T_front_degC T_rear_degC (housing at the bearing, side +x; bearing), T_motor_degC
                 // (housing at the motor, side +x), T_housing_degC (its front end, side +y; housing), T_coolant_degC
                 // (tank; coolant), T_head_degC, T_column_degC (front; both structure), T_room_degC (ambient). True.
  Series truth;  // x_um, y_um, z_um, then the causes above: x_bending_um ...
  HeatBalance balance;
  std::vector<ShaftProfile> profiles;  // one for each of profile_s. At the start: as the machine has stood
};

// Backward Euler over a sparse network of some 210 nodes: stable for every step, energy in balance to 1e-9. 46 h in
// steps of 15 s take 0.25 s on one core. Accuracy at the defaults, of z: 1 % from the step while it warms fastest, 0.5
// % from the cells. The thermostat is asked at the start of every step: long steps make its cycle long and wide. Throws
// Error, "spindle: ...", where a value makes no sense: a mass not above 0, a bearing outside the housing, times that do
// not rise.
ThermalRun run_of(const FiniteVolumeSpindle& spindle, const DutyPlan& plan, const Mechanisms& mechanisms = {},
                  const ThermalClock& clock = {});

enum class Bound { positive, not_negative, any };

// The numbers above by name, for files and messages.
struct SpindleParameter {
  std::string_view name;
  double FiniteVolumeSpindle::*member;
  Bound bound;
};
std::span<const SpindleParameter> spindle_parameters();

struct Mechanism {
  std::string_view name;
  bool Mechanisms::*member;
};
std::span<const Mechanism> mechanisms();

}  // namespace ballbar
