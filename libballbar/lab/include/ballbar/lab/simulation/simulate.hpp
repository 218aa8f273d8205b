// A virtual machine with a ballbar on it: recordings, signals and five-probe readings from stated truth.
//
// The lengths come from forward kinematics: chains of rigid transformations carry the two balls, and the
// bar's length is the distance between them. Nothing of the fit is used, so a fit that recovers the truth
// has been tested. Noise, resolution, set-up error and the drift itself are stated; the same machine
// gives the same bytes. The position of a test is the truth at the test's start, constant during its
// sweeps; between stated points the truth is linear, and a single point holds for ever.
//
// Frame of the machine: X, Y, Z with Z up along the spindle (the table below), R = nominal + radius error.
//
//   two_arcs          origin where A (about X) and C (about Z) meet. Spindle's ball at set-up + truth.
//                     Table's ball at (R, 0, h) of the table; path 1 turns C, path 2 turns A with C at
//                     90 deg: radius sqrt(R^2 + h^2) about A, height 0. Drift = +truth.
//   circles           table's ball at the origin; the linear axes carry the spindle's ball round a circle
//                     in `plane`, h above it, displaced by set-up + truth. Drift = +truth. Each test has a
//                     CCW and a CW recording. Drift normal to the plane adds to h, unknown to the log.
//   spindle_rotation  the table's ball P stands at (R, 0, h); the spindle turns clockwise seen from +Z,
//                     its ball O at -c of the turning frame, so that P runs around O with the logged
//                     angle: P - O = c + R (cos theta, sin theta) seen from the spindle, with
//                     c = set-up + run-out + truth. x and y of the truth are therefore the change of the
//                     fitted centre, and O itself moves by (-x, -y) in the turning frame. Logged as
//                     moving_ball = table. Elongation z lowers O: the normal part of P - O is h + z.
//                     Axial: the bar stands on the table's second mount under the spindle, length
//                     nominal + axial offset - z; + z where spindle_above is false (ball on the far side).
//
// A spindle (finite_volume_spindle.hpp) may stand in for the stated truth. Its x, y are those of the truth and its
// elongation z is -z of the truth, for Z points up; spindle_rotation states elongation, and shows the fixed-frame x as
// -along_bar, since nothing of the spindle's turns with it. Its sensors join the signals. Alone it makes a series: no
// ballbar, x, y and z as dense as its rows.
//
// Angles are uniform at mid-sample, start + (i + 1/2) (end - start) / n, to 1e-9 deg; times likewise over
// R arc / feed, to 1 us.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "ballbar/circle/recording.hpp"
#include "ballbar/drift/drift.hpp"
#include "ballbar/lab/simulation/virtual_spindle.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

// Displacement of the spindle's ball relative to the table, um, machine frame. For spindle_rotation see
// above; along_bar_um is the fixed-frame drift of the spindle's axis away from the table's ball.
struct TruePosition {
  double time_s = 0.0;
  double x_um = 0.0;
  double y_um = 0.0;
  double z_um = 0.0;  // spindle_rotation: elongation towards the table
  double along_bar_um = 0.0;
};

// Angles of the recording in deg, in the direction of travel; end < start is CW. At most a full turn.
struct Sweep {
  double start_deg = 0.0;
  double end_deg = 360.0;
  std::size_t readings = 1500;
};

// A reading is the true length + noise + outlier, rounded last.
struct VirtualBar {
  double nominal_length_mm = 100.0;
  double radius_error_um = 0.0;  // path radius R = nominal length + this
  double noise_um = 0.2;         // standard deviation of a reading
  double autocorrelation = 0.0;  // AR(1) of that noise, 0 <= phi < 1; noise_um stays its deviation
  double resolution_um = 0.1;    // lengths are multiples of it; 0: not rounded
  double outlier_share = 0.0;    // probability that a reading is off by outlier_um
  double outlier_um = 0.0;
};

// Axial recordings of a spindle_rotation session.
struct VirtualAxial {
  std::size_t readings = 0;  // a log a test; 0: one value a test, SessionTest::axial_length_mm
  double interval_s = 0.01;
  double offset_um = 0.0;  // of the bar's length without elongation from the nominal length
};

// Rigid test bar and five probes at every interval, from the first test to the last. With s along the bar
// from plane 1 towards plane 2, the spindle's ball (whose drift is the truth) at s = ball_offset_mm = b:
//   X1 = x - B b   X2 = x + B (d - b)   Y1 = y + A b   Y2 = y - A (d - b)   Z = z   (x, y, z since the first test)
//   B = tilt_b x,  A = tilt_a y
// so that tilts have the signs B = (X2 - X1)/d, A = -(Y2 - Y1)/d.
struct VirtualFiveProbe {
  bool present = false;
  double spacing_mm = 60.0;  // d
  double interval_s = 60.0;
  double noise_um = 0.1;
  double resolution_um = 0.05;
  double tilt_a_urad_per_um = 0.0;  // tilt about X for each um of y
  double tilt_b_urad_per_um = 0.0;  // tilt about Y for each um of x
  double ball_offset_mm = 0.0;
};

// One logged signal: straight lines between stated points, held beyond them, with white noise, rounded last.
struct VirtualSignal {
  std::string name;  // ends in its unit
  Role role = Role::structure;
  std::vector<double> time_s;  // stated points, rising
  std::vector<double> value;   // same size
  double noise = 0.0;          // standard deviation
  double resolution = 0.0;     // 0: not rounded
};

struct VirtualMachine {
  std::string name = "virtual machine";  // for messages: the file it came from
  Method method = Method::two_arcs;
  std::string title;
  std::vector<TruePosition> truth;  // at least one, times rising; none where there is a spindle
  std::optional<VirtualSpindle> spindle;
  bool series = false;                    // the spindle's series alone; of the rest only title and seed count
  std::vector<double> test_s;             // when tests start, rising
  std::optional<std::int64_t> started_s;  // local clock at time 0, s since 1970-01-01T00:00:00
  VirtualBar bar;
  Sweep c_arc{90.0, 450.0, 1500};                               // two_arcs: about C
  Sweep a_arc{-20.0, 80.0, 800};                                // two_arcs: about A
  Sweep circle{0.0, 360.0, 1500};                               // spindle_rotation; circles: as stated, then back
  VirtualAxial axial;                                           // spindle_rotation
  Plane plane = Plane::XY;                                      // circles
  double feed_mm_per_min = 1000.0;                              // on the path; a turning axis has omega = feed / R
  double setup_x_um = 0.0, setup_y_um = 0.0, setup_z_um = 0.0;  // constant set-up error, signs as the truth
  double run_out_um = 0.0;                                      // spindle_rotation: eccentricity, adds to c along A
  double height_offset_mm = 0.0;                                // h of recording.hpp
  bool spindle_above = true;                                    // spindle_rotation
  double harmonic2_um = 0.0;   // circles: scale mismatch, axis A too long and B too short by this over R
  double backlash_a_um = 0.0;  // circles: play of axis A, half of it behind the motion either way
  double interval_s = 10.0;    // of the logged signals, from the first test to the last
  std::vector<VirtualSignal> signals;
  VirtualFiveProbe five_probe;
  std::uint64_t seed = 1;
};

struct SimulatedSession {
  Session session;
  Series signals;     // no columns where the machine has none
  Series five_probe;  // no columns where absent
  double ball_from_plane_1_mm = 0.0;
  Series series;  // of a spindle alone: its sensors, then x_um, y_um, z_um, z_um positive towards the table
  Series truth;   // one row per test: what drift_of would give without noise, changes since the first test:
                  // x_um, y_um, z_um; spindle_rotation: radial_um, axial_um, shift_a_um, shift_b_um,
                  // radius_change_um. Of a spindle also the causes; of a spindle alone ThermalRun::truth
  std::vector<ShaftProfile> profiles;  // of a spindle, at the times that its clock asks for
};

// Every recording, signal and probe draws from its own random stream, keyed by seed, kind and test time or
// column name: adding a test or a signal changes no other, and machines alike in these have the same noise whatever
// else they differ in, such as the feed: measurements to be taken together need seeds of their own. Independent of the
// standard library's distributions. Throws Error, naming the machine, where it is contradictory: no truth, times that
// do not rise, a test outside the truth, an arc of 0, negative noise, an input its method does not have.
SimulatedSession simulate(const VirtualMachine& machine);

}  // namespace ballbar
