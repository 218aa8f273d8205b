// A virtual machine with a ballbar on it: recordings, signals and five-probe readings from stated truth.
//
// The lengths come from forward kinematics: rigid transformations of axes carry the balls, the bar's
// length is the distance between them. Nothing of the fit is used, so a fit that recovers the truth has
// been tested. Noise, resolution, set-up offset and the drift itself are stated; the same seed gives the
// same session.
//
// Frames: machine frame, Z up along the spindle, X the axis of A, origin where A and C meet (two_arcs) or
// where the spindle axis meets the plane of the bar (otherwise). The truth is the displacement of the
// spindle's ball relative to the table at each test, linear between the stated points.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "ballbar/drift.hpp"
#include "ballbar/recording.hpp"
#include "ballbar/series.hpp"

namespace ballbar {

// Displacement of the spindle's ball relative to the table, um. For spindle_rotation, x and y are the
// radial shift in the frame that turns with the spindle, z the elongation towards the table,
// and along_bar_um the fixed-frame drift of the axis away from the table's ball.
struct TruePosition {
  double time_s = 0.0;
  double x_um = 0.0;
  double y_um = 0.0;
  double z_um = 0.0;
  double along_bar_um = 0.0;
};

// Angles in deg, in the direction of travel; end < start is CW.
struct Sweep {
  double start_deg = 0.0;
  double end_deg = 360.0;
  std::size_t readings = 1500;
};

struct VirtualBar {
  double nominal_length_mm = 100.0;
  double radius_error_um = 0.0;      // path radius = nominal length + this
  double noise_um = 0.2;             // standard deviation of a reading
  double autocorrelation = 0.0;      // AR(1) of that noise, 0 <= phi < 1
  double resolution_um = 0.1;        // readings are rounded to it; 0: not rounded
  double outlier_share = 0.0;        // of readings that are off by outlier_um
  double outlier_um = 0.0;
};

struct VirtualFiveProbe {
  bool present = false;
  double spacing_mm = 60.0;
  double interval_s = 60.0;
  double noise_um = 0.1;
  double resolution_um = 0.05;
  double tilt_a_urad_per_um = 0.0;  // tilt about X grows with y drift: urad per um
  double tilt_b_urad_per_um = 0.0;  // tilt about Y grows with x drift
  double nose_offset_mm = 0.0;      // distance of plane 1 from the point whose drift the truth states
};

// One logged signal: a first-order response between stated points, with noise and resolution.
struct VirtualSignal {
  std::string name;                 // ends in its unit
  Role role = Role::structure;
  std::vector<double> time_s;       // stated points, rising
  std::vector<double> value;        // same size
  double noise = 0.0;
  double resolution = 0.0;
};

struct VirtualMachine {
  Method method = Method::two_arcs;
  std::string title;
  std::vector<TruePosition> truth;  // at least one, times rising
  std::vector<double> test_s;       // when tests start
  VirtualBar bar;
  Sweep c_arc{90.0, 450.0, 1500};   // two_arcs: about C
  Sweep a_arc{-20.0, 80.0, 800};    // two_arcs: about A
  Sweep circle{0.0, 360.0, 1500};   // circles (both directions) and spindle_rotation
  Plane plane = Plane::XY;          // circles
  double feed_mm_per_min = 1000.0;
  double setup_x_um = 0.0, setup_y_um = 0.0, setup_z_um = 0.0;  // constant set-up error of the spindle's ball
  double run_out_um = 0.0;          // eccentricity of the spindle's ball (spindle_rotation: turns with it)
  double height_offset_mm = 0.0;    // h of recording.hpp, all recordings
  double harmonic2_um = 0.0;        // circles: amplitude of cos 2 theta (scale mismatch), both directions
  double backlash_a_um = 0.0;       // circles: reversal play of axis A
  double interval_s = 10.0;         // of the logged signals
  std::vector<VirtualSignal> signals;
  VirtualFiveProbe five_probe;
  std::uint64_t seed = 1;
};

struct SimulatedSession {
  Session session;
  Series signals;     // no columns where the machine has none
  Series five_probe;  // no columns where absent
  Series truth;       // time_s, x_um, y_um, z_um (along_bar_um) at each test, before noise, set-up left out
};

// Throws Error where the machine is contradictory (no truth, times not rising, arc of 0, negative noise).
SimulatedSession simulate(const VirtualMachine& machine);

}  // namespace ballbar
