#include "ballbar/lab/simulation/simulate.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "ballbar/units.hpp"

namespace ballbar {
namespace {

// Lengths of a few mm: double precision leaves 1e-15 mm, the chains of transformations a few of those.
constexpr double kTolerance_mm = 1e-13;

// A machine with nothing but geometry: R = 4 mm, so that 3-4-5 triangles can be set up in whole mm.
VirtualMachine quiet(Method method, const TruePosition& truth = {}) {
  VirtualMachine machine;
  machine.method = method;
  machine.truth = {truth};
  machine.test_s = {0.0};
  machine.bar.nominal_length_mm = 4.0;
  machine.bar.noise_um = 0.0;
  machine.bar.resolution_um = 0.0;
  return machine;
}

// One reading, at this angle: mid-sample of a symmetrical sweep.
Sweep at_deg(double angle_deg) { return {angle_deg - 10.0, angle_deg + 10.0, 1}; }

double c_length_mm(VirtualMachine machine, double angle_deg) {
  machine.c_arc = at_deg(angle_deg);
  return simulate(machine).session.tests.at(0).c_arc->length_mm.at(0);
}

double a_length_mm(VirtualMachine machine, double angle_deg) {
  machine.a_arc = at_deg(angle_deg);
  return simulate(machine).session.tests.at(0).a_arc->length_mm.at(0);
}

// The recording in the sweep's own direction, or the way back.
double circle_length_mm(VirtualMachine machine, double angle_deg, bool back = false) {
  machine.circle = at_deg(angle_deg);
  return simulate(machine).session.tests.at(0).circles.at(back ? 1 : 0).length_mm.at(0);
}

double rotation_length_mm(VirtualMachine machine, double angle_deg) {
  machine.circle = at_deg(angle_deg);
  return simulate(machine).session.tests.at(0).rotation->length_mm.at(0);
}

TruePosition x_mm(double shift_mm) { return {0.0, um_from_mm(shift_mm), 0.0, 0.0, 0.0}; }
TruePosition y_mm(double shift_mm) { return {0.0, 0.0, um_from_mm(shift_mm), 0.0, 0.0}; }
TruePosition z_mm(double shift_mm) { return {0.0, 0.0, 0.0, um_from_mm(shift_mm), 0.0}; }

// The table's ball is at (4 cos t, 4 sin t, 0), the spindle's at the stated displacement.
TEST(SimulateTwoArcs, PathAboutC) {
  // +X shortens the bar on the +X side: 4 - 1 and 4 + 1.
  EXPECT_NEAR(c_length_mm(quiet(Method::two_arcs, x_mm(1.0)), 0.0), 3.0, kTolerance_mm);
  EXPECT_NEAR(c_length_mm(quiet(Method::two_arcs, x_mm(1.0)), 180.0), 5.0, kTolerance_mm);
  EXPECT_NEAR(c_length_mm(quiet(Method::two_arcs, y_mm(1.0)), 90.0), 3.0, kTolerance_mm);
  EXPECT_NEAR(c_length_mm(quiet(Method::two_arcs, x_mm(3.0)), 90.0), 5.0, kTolerance_mm);
  // z is out of the plane: 3-4-5 at every angle.
  for (const double angle_deg : {0.0, 77.0, 200.0}) {
    EXPECT_NEAR(c_length_mm(quiet(Method::two_arcs, z_mm(3.0)), angle_deg), 5.0, kTolerance_mm);
  }
}

// C at 90 deg: the table's ball is at (0, 4 cos t, 4 sin t).
TEST(SimulateTwoArcs, PathAboutA) {
  EXPECT_NEAR(a_length_mm(quiet(Method::two_arcs, y_mm(1.0)), 0.0), 3.0, kTolerance_mm);
  EXPECT_NEAR(a_length_mm(quiet(Method::two_arcs, z_mm(1.0)), 90.0), 3.0, kTolerance_mm);
  EXPECT_NEAR(a_length_mm(quiet(Method::two_arcs, z_mm(1.0)), -90.0), 5.0, kTolerance_mm);
  EXPECT_NEAR(a_length_mm(quiet(Method::two_arcs, z_mm(3.0)), 0.0), 5.0, kTolerance_mm);
  EXPECT_NEAR(a_length_mm(quiet(Method::two_arcs, x_mm(3.0)), 30.0), 5.0, kTolerance_mm);
}

// Table's ball 3 above the plane of path 1: 3-4-5 there; about A it runs at 5 from the axis, in the plane.
TEST(SimulateTwoArcs, HeightOfTheTablesBall) {
  VirtualMachine machine = quiet(Method::two_arcs);
  machine.height_offset_mm = 3.0;
  EXPECT_NEAR(c_length_mm(machine, 20.0), 5.0, kTolerance_mm);
  EXPECT_NEAR(a_length_mm(machine, 20.0), 5.0, kTolerance_mm);
  machine.setup_y_um = 1000.0;  // the logged angle is the ball's own: at 0 deg it is at (0, 5, 0)
  EXPECT_NEAR(a_length_mm(machine, 0.0), 4.0, kTolerance_mm);
  const SessionTest test = simulate(machine).session.tests.at(0);
  EXPECT_EQ(test.c_arc->height_offset_mm, 3.0);
  EXPECT_EQ(test.a_arc->height_offset_mm, 0.0);
}

TEST(SimulateTwoArcs, SetUpAddsToTheTruth) {
  VirtualMachine machine = quiet(Method::two_arcs, x_mm(0.25));
  machine.setup_x_um = 750.0;
  EXPECT_NEAR(c_length_mm(machine, 0.0), 3.0, kTolerance_mm);
  machine.bar.radius_error_um = 500.0;
  EXPECT_NEAR(c_length_mm(machine, 0.0), 3.5, kTolerance_mm);
}

TEST(SimulateTwoArcs, LabelsAnglesAndTimes) {
  VirtualMachine machine = quiet(Method::two_arcs);
  machine.c_arc = {90.0, 450.0, 4};
  machine.a_arc = {80.0, -20.0, 2};
  machine.feed_mm_per_min = 60.0;  // 1 mm/s: the turn of 8 pi mm takes 8 pi s, 2 pi s a reading
  machine.started_s = 1000;
  machine.test_s = {480.0};
  const SessionTest test = simulate(machine).session.tests.at(0);
  EXPECT_EQ(test.elapsed_s, 480.0);
  EXPECT_EQ(test.c_arc->motion, Motion::rotary_axis);
  EXPECT_EQ(test.c_arc->moving_ball, MovingBall::table);
  EXPECT_EQ(test.c_arc->plane, Plane::XY);
  EXPECT_EQ(test.c_arc->direction, Direction::CCW);
  EXPECT_EQ(test.c_arc->elapsed_s, 480.0);
  EXPECT_EQ(test.c_arc->started_s, 1480);
  EXPECT_EQ(test.a_arc->plane, Plane::YZ);
  EXPECT_EQ(test.a_arc->direction, Direction::CW);
  EXPECT_NEAR(test.c_arc->angle_rad.at(0), rad_from_deg(135.0), 1e-15);
  EXPECT_NEAR(test.c_arc->angle_rad.at(3), rad_from_deg(405.0), 1e-14);
  EXPECT_NEAR(test.a_arc->angle_rad.at(0), rad_from_deg(55.0), 1e-15);
  EXPECT_NEAR(test.a_arc->angle_rad.at(1), rad_from_deg(5.0), 1e-15);
  EXPECT_NEAR(test.c_arc->time_s.at(0), kPi, 0.5e-6);  // logged to 1 us
  EXPECT_NEAR(test.c_arc->time_s.at(3), 7.0 * kPi, 0.5e-6);
}

// The table's ball is the origin; the spindle's runs round it: +X lengthens the bar on the +X side.
TEST(SimulateCircles, SignOfEachAxisInEachPlane) {
  struct Case {
    Plane plane;
    TruePosition along_a, along_b, along_normal;
  };
  const Case cases[] = {{Plane::XY, x_mm(1.0), y_mm(1.0), z_mm(1.0)},
                        {Plane::YZ, y_mm(1.0), z_mm(1.0), x_mm(1.0)},
                        {Plane::ZX, z_mm(1.0), x_mm(1.0), y_mm(1.0)}};
  for (const Case& one : cases) {
    SCOPED_TRACE(name_of(one.plane));
    VirtualMachine machine = quiet(Method::circles, one.along_a);
    machine.plane = one.plane;
    EXPECT_NEAR(circle_length_mm(machine, 0.0), 5.0, kTolerance_mm);
    EXPECT_NEAR(circle_length_mm(machine, 180.0), 3.0, kTolerance_mm);
    machine.truth = {one.along_b};
    EXPECT_NEAR(circle_length_mm(machine, 90.0), 5.0, kTolerance_mm);
    EXPECT_NEAR(circle_length_mm(machine, 270.0), 3.0, kTolerance_mm);
    machine.truth = {one.along_normal};  // adds to h = 2: 3-4-5 at every angle
    machine.height_offset_mm = 2.0;
    EXPECT_NEAR(circle_length_mm(machine, 33.0), 5.0, kTolerance_mm);
  }
}

TEST(SimulateCircles, ThereAndBack) {
  VirtualMachine machine = quiet(Method::circles);
  machine.circle = {30.0, 150.0, 3};
  const SessionTest test = simulate(machine).session.tests.at(0);
  ASSERT_EQ(test.circles.size(), 2U);
  EXPECT_EQ(test.circles[0].direction, Direction::CCW);
  EXPECT_EQ(test.circles[1].direction, Direction::CW);
  EXPECT_EQ(test.circles[0].motion, Motion::linear_axes);
  EXPECT_EQ(test.circles[0].moving_ball, MovingBall::spindle);
  EXPECT_NEAR(test.circles[0].angle_rad.at(0), rad_from_deg(50.0), 1e-15);
  EXPECT_NEAR(test.circles[1].angle_rad.at(0), rad_from_deg(130.0), 1e-15);
}

// Axis A 1 mm too long over R = 4, axis B 1 mm too short: 4 + 1 at 0 deg, 4 - 1 at 90 deg.
TEST(SimulateCircles, ScaleMismatch) {
  VirtualMachine machine = quiet(Method::circles);
  machine.harmonic2_um = 1000.0;
  EXPECT_NEAR(circle_length_mm(machine, 0.0), 5.0, kTolerance_mm);
  EXPECT_NEAR(circle_length_mm(machine, 90.0), 3.0, kTolerance_mm);
}

// At 90 deg CCW, A moves towards -A, so play of 4 mm leaves it 2 mm on the + side; set up 1 mm off: a = 3 and
// b = 4. On the way back it is 2 mm on the - side: a = -1.
TEST(SimulateCircles, Backlash) {
  VirtualMachine machine = quiet(Method::circles);
  machine.backlash_a_um = 4000.0;
  machine.setup_x_um = 1000.0;
  EXPECT_NEAR(circle_length_mm(machine, 90.0), 5.0, kTolerance_mm);
  EXPECT_NEAR(circle_length_mm(machine, 90.0, true), std::sqrt(17.0), kTolerance_mm);
}

// P - O = c + R (cos t, sin t) seen from the spindle: a shift of c along A lengthens the bar at 0 deg.
TEST(SimulateSpindleRotation, ShiftTurnsWithTheSpindle) {
  EXPECT_NEAR(rotation_length_mm(quiet(Method::spindle_rotation, x_mm(1.0)), 0.0), 5.0, kTolerance_mm);
  EXPECT_NEAR(rotation_length_mm(quiet(Method::spindle_rotation, x_mm(1.0)), 180.0), 3.0, kTolerance_mm);
  EXPECT_NEAR(rotation_length_mm(quiet(Method::spindle_rotation, y_mm(1.0)), 90.0), 5.0, kTolerance_mm);
  EXPECT_NEAR(rotation_length_mm(quiet(Method::spindle_rotation, x_mm(3.0)), 90.0), 5.0, kTolerance_mm);
  VirtualMachine machine = quiet(Method::spindle_rotation);
  machine.run_out_um = 1000.0;
  EXPECT_NEAR(rotation_length_mm(machine, 0.0), 5.0, kTolerance_mm);
}

TEST(SimulateSpindleRotation, DriftAlongTheBarIsTheRadius) {
  VirtualMachine machine = quiet(Method::spindle_rotation, {0.0, 0.0, 0.0, 0.0, 1000.0});
  EXPECT_NEAR(rotation_length_mm(machine, 0.0), 5.0, kTolerance_mm);
  EXPECT_NEAR(rotation_length_mm(machine, 123.0), 5.0, kTolerance_mm);
}

// h = 2 and 1 of elongation: 3-4-5; what is in the plane is left by rho = sqrt(L^2 - (h + dL)^2).
TEST(SimulateSpindleRotation, ElongationLiftsTheBar) {
  VirtualMachine machine = quiet(Method::spindle_rotation, z_mm(1.0));
  machine.height_offset_mm = 2.0;
  EXPECT_NEAR(rotation_length_mm(machine, 60.0), 5.0, kTolerance_mm);
  machine = quiet(Method::spindle_rotation, {0.0, 0.0, 0.0, 20.0, 0.0});
  machine.bar.nominal_length_mm = 100.0;
  machine.height_offset_mm = 5.0;
  const double length_mm = rotation_length_mm(machine, 60.0);
  EXPECT_NEAR(std::sqrt(length_mm * length_mm - 5.02 * 5.02), 100.0, 1e-12);
  // The library's correction is the same 1.0 um: sqrt(100^2 + 5.02^2) - sqrt(100^2 + 5^2) = 1.0007 um.
  machine.truth = {TruePosition{}};
  EXPECT_NEAR(um_from_mm(length_mm - rotation_length_mm(machine, 60.0)), 1.0007, 0.0001);
}

// Growth towards the table shortens the standing bar; with the ball on the far side it lengthens it.
TEST(SimulateSpindleRotation, AxialLength) {
  VirtualMachine machine = quiet(Method::spindle_rotation, z_mm(1.0));
  machine.axial.offset_um = 500.0;
  EXPECT_NEAR(*simulate(machine).session.tests.at(0).axial_length_mm, 3.5, kTolerance_mm);
  machine.spindle_above = false;
  EXPECT_NEAR(*simulate(machine).session.tests.at(0).axial_length_mm, 5.5, kTolerance_mm);
  EXPECT_FALSE(simulate(machine).session.spindle_above);
}

TEST(SimulateSpindleRotation, AxialLog) {
  VirtualMachine machine = quiet(Method::spindle_rotation, z_mm(1.0));
  machine.axial.readings = 3;
  machine.axial.interval_s = 0.25;
  const SessionTest test = simulate(machine).session.tests.at(0);
  EXPECT_FALSE(test.axial_length_mm.has_value());
  EXPECT_EQ(test.axial->kind, Kind::axial);
  EXPECT_EQ(test.axial->time_s, (std::vector<double>{0.0, 0.25, 0.5}));
  EXPECT_NEAR(test.axial->length_mm.at(2), 3.0, kTolerance_mm);
  EXPECT_TRUE(test.axial->angle_rad.empty());
  EXPECT_EQ(test.rotation->motion, Motion::spindle);
  EXPECT_EQ(test.rotation->moving_ball, MovingBall::table);
}

// F = 9426 mm/min at R = 100 mm: omega = F / R = 94.26 rad/min = 15.0 rpm, a turn in 4.0 s (not 30 rpm).
TEST(SimulateSpindleRotation, FeedOfThePaper) {
  VirtualMachine machine = quiet(Method::spindle_rotation);
  machine.bar.nominal_length_mm = 100.0;
  machine.feed_mm_per_min = 9426.0;
  machine.circle = {0.0, 360.0, 1000};
  const Recording rotation = *simulate(machine).session.tests.at(0).rotation;
  EXPECT_NEAR(60.0 / (rotation.time_s[1] - rotation.time_s[0]) / 1000.0, 15.0, 0.01);
}

// Truth is linear between its points and constant during a test: 10 um at 60 s, half of it at 30 s.
TEST(Simulate, TruthBetweenItsPoints) {
  VirtualMachine machine = quiet(Method::two_arcs);
  machine.truth = {{0.0, 1.0, 2.0, 3.0, 0.0}, {60.0, 11.0, 2.0, -7.0, 0.0}};
  machine.test_s = {0.0, 30.0, 60.0};
  machine.c_arc = at_deg(0.0);
  const SimulatedSession simulated = simulate(machine);
  // x = 6 um, y = 2 um, z = -2 um: 4 - 0.006 along X, (2^2 + 2^2) um^2 / (2 * 3.994 mm) = 1.0e-6 mm across
  EXPECT_NEAR(simulated.session.tests.at(1).c_arc->length_mm.at(0), 3.994 + 8e-6 / (2.0 * 3.994), 1e-11);
  EXPECT_EQ(simulated.truth.time_s, machine.test_s);
  EXPECT_EQ(find_column(simulated.truth, "x_um")->values, (std::vector<double>{0.0, 5.0, 10.0}));
  EXPECT_EQ(find_column(simulated.truth, "y_um")->values, (std::vector<double>{0.0, 0.0, 0.0}));
  EXPECT_EQ(find_column(simulated.truth, "z_um")->values, (std::vector<double>{0.0, -5.0, -10.0}));
}

TEST(Simulate, TruthOfASpindleRotation) {
  VirtualMachine machine = quiet(Method::spindle_rotation);
  machine.truth = {{0.0, 1.0, 1.0, 2.0, 0.5}, {60.0, 4.0, 5.0, 12.0, 2.0}};
  machine.test_s = {0.0, 60.0};
  const Series truth = simulate(machine).truth;
  EXPECT_EQ(find_column(truth, "radial_um")->values, (std::vector<double>{0.0, 5.0}));  // 3-4-5
  EXPECT_EQ(find_column(truth, "axial_um")->values, (std::vector<double>{0.0, 10.0}));
  EXPECT_EQ(find_column(truth, "shift_a_um")->values, (std::vector<double>{0.0, 3.0}));
  EXPECT_EQ(find_column(truth, "shift_b_um")->values, (std::vector<double>{0.0, 4.0}));
  EXPECT_EQ(find_column(truth, "radius_change_um")->values, (std::vector<double>{0.0, 1.5}));
}

TEST(Simulate, SignalsAreStraightBetweenTheirPoints) {
  VirtualMachine machine = quiet(Method::two_arcs);
  machine.test_s = {0.0, 25.0};
  machine.interval_s = 10.0;
  machine.signals = {{"T_air_degC", Role::ambient, {5.0, 15.0}, {20.0, 20.8}, 0.0, 0.25}};
  const Series signals = simulate(machine).signals;
  EXPECT_EQ(signals.time_s, (std::vector<double>{0.0, 10.0, 20.0, 30.0}));  // to the first time after the last test
  EXPECT_EQ(signals.columns.at(0).role, Role::ambient);
  // held at 20.0; 20.4 and then 20.8, held, to the nearest multiple of 0.25
  EXPECT_EQ(signals.columns.at(0).values, (std::vector<double>{20.0, 20.5, 20.75, 20.75}));
}

// Ball at s = 20 mm, planes at 0 and 60 mm; x = 10 um tilts B by 10 * 2 urad = 0.02 um/mm: X1 = 10 - 0.4,
// X2 = 10 + 0.8. y = 10 um tilts A by 0.01 um/mm, A = -(Y2 - Y1)/d: Y1 = 10 + 0.2, Y2 = 10 - 0.4.
TEST(Simulate, FiveProbes) {
  VirtualMachine machine = quiet(Method::two_arcs);
  machine.truth = {{0.0, 5.0, 0.0, 0.0, 0.0}, {60.0, 15.0, 10.0, 3.0, 0.0}};
  machine.test_s = {0.0, 60.0};
  machine.five_probe = {true, 60.0, 60.0, 0.0, 0.0, 1.0, 2.0, 20.0};
  const Series probes = simulate(machine).five_probe;
  EXPECT_EQ(probes.five_probe->spacing_mm, 60.0);
  const double expected_um[] = {9.6, 10.8, 10.2, 9.6, 3.0};
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(probes.columns.at(i).values.at(0), 0.0) << probes.columns[i].name;
    EXPECT_NEAR(probes.columns.at(i).values.at(1), expected_um[i], 1e-12) << probes.columns[i].name;
  }
}

}  // namespace
}  // namespace ballbar
