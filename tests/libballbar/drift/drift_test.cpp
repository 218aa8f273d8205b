#include "ballbar/drift/drift.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "ballbar/error.hpp"
#include "ballbar/lab/simulation/simulate.hpp"
#include "ballbar/units.hpp"

namespace ballbar {
namespace {

VirtualMachine quiet(Method method) {
  VirtualMachine machine;
  machine.method = method;
  machine.bar.noise_um = 0.0;
  machine.bar.resolution_um = 0.0;
  machine.setup_x_um = 40.0;
  machine.setup_y_um = -25.0;
  machine.setup_z_um = 10.0;
  machine.test_s = {0.0, 600.0, 1200.0};
  return machine;
}

void expect_estimate(const std::optional<Estimate>& estimate, double value_um, double tolerance_um) {
  ASSERT_TRUE(estimate.has_value());
  EXPECT_NEAR(estimate->value_um, value_um, tolerance_um);
}

// Without noise the drift comes back to 1e-6 um (100 mm in double precision, a 100 deg arc), whatever the set-up
// error, joint and sequential.
TEST(Drift, TwoArcsGiveTheTruthBack) {
  VirtualMachine machine = quiet(Method::two_arcs);
  machine.truth = {{0.0, 3.0, 2.1, 3.9, 0.0}, {1200.0, 7.4, 32.2, 8.5, 0.0}};
  const Session session = simulate(machine).session;
  for (const bool sequential : {false, true}) {
    DriftOptions options;
    options.sequential = sequential;
    const DriftSeries series = drift_of(session, options);
    ASSERT_EQ(series.points.size(), 3U);
    const double tolerance_um = sequential ? 5e-5 : 1e-6;  // path 1 alone takes z^2 / 2R = 0.0003 um for radius
    expect_estimate(series.points[0].x, 0.0, 0.0);
    expect_estimate(series.points[1].x, 2.2, tolerance_um);
    expect_estimate(series.points[2].x, 4.4, tolerance_um);
    expect_estimate(series.points[2].y, 30.1, tolerance_um);
    expect_estimate(series.points[2].z, 4.6, tolerance_um);
    expect_estimate(series.positions[2].y, 32.2 - 25.0, tolerance_um);
    EXPECT_EQ(series.reference_s, 0.0);
    EXPECT_FALSE(series.points[2].radial.has_value());
  }
}

TEST(Drift, TwoArcsWithAHeightNeedTheJointFit) {
  VirtualMachine machine = quiet(Method::two_arcs);
  machine.height_offset_mm = 5.0;
  machine.truth = {{0.0, 0.0, 0.0, 0.0, 0.0}, {1200.0, 4.0, 30.0, 20.0, 0.0}};
  const DriftSeries series = drift_of(simulate(machine).session);
  expect_estimate(series.points[2].x, 4.0, 1e-5);
  expect_estimate(series.points[2].y, 30.0, 1e-5);
  expect_estimate(series.points[2].z, 20.0, 1e-5);
}

TEST(Drift, JointKnowsZNoWorseThanSequential) {
  VirtualMachine machine = quiet(Method::two_arcs);
  machine.bar.noise_um = 0.2;
  machine.truth = {{0.0, 3.0, 2.1, 3.9, 0.0}, {1200.0, 7.4, 32.2, 8.5, 0.0}};
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    machine.seed = seed;
    const Session session = simulate(machine).session;
    DriftOptions sequential;
    sequential.sequential = true;
    const DriftSeries one_by_one = drift_of(session, sequential);
    const DriftSeries joint = drift_of(session);
    for (std::size_t i = 0; i < joint.positions.size(); ++i) {
      EXPECT_LE(joint.positions[i].z->sigma_um, one_by_one.positions[i].z->sigma_um * 1.0001) << "seed " << seed;
    }
    EXPECT_NEAR(joint.points[2].z->value_um, 4.6, 5.0 * joint.points[2].z->sigma_um);
    EXPECT_NEAR(one_by_one.points[2].z->value_um, 4.6, 5.0 * one_by_one.points[2].z->sigma_um);
  }
}

// radial is the size of the shift in the turning frame, axial the elongation, radius the fixed-frame drift.
TEST(Drift, SpindleRotationSeparatesRadialAxialAndRadius) {
  VirtualMachine machine = quiet(Method::spindle_rotation);
  machine.height_offset_mm = 5.0;
  machine.truth = {{0.0, 0.0, 0.0, 0.0, 0.0}, {1200.0, 3.0, 4.0, 20.0, 2.0}};
  const DriftSeries series = drift_of(simulate(machine).session);
  expect_estimate(series.points[2].radial, 5.0, 1e-4);
  // A ball 50 um off the axis tilts the bar: 50^2 / 2e5 um = 0.01 um, of which the shift of 5 um changes a hundredth.
  expect_estimate(series.points[2].axial, 20.0, 1e-3);
  // The set-up error of 10 um in z adds to h unseen: 2 * 0.01 * 0.02 mm^2 / 200 mm = 0.002 um.
  expect_estimate(series.points[2].radius_change, 2.0, 0.003);
  ASSERT_TRUE(series.points[2].elongation_correction_um.has_value());
  EXPECT_NEAR(*series.points[2].elongation_correction_um, 1.0007, 1e-3) << "h = 5 mm, 20 um";
  EXPECT_FALSE(series.points[2].x.has_value());
}

TEST(Drift, AnAxialLengthReadOffADisplayHasNoSigma) {
  VirtualMachine machine = quiet(Method::spindle_rotation);
  machine.bar.noise_um = 0.2;
  machine.truth = {{0.0, 0.0, 0.0, 0.0, 0.0}, {1200.0, 3.0, 4.0, 20.0, 0.0}};
  Session session = simulate(machine).session;
  for (SessionTest& test : session.tests) {
    test.axial.reset();
    test.axial_length_mm = 99.9874 - 1e-5 * test.elapsed_s;
  }
  const DriftSeries series = drift_of(session);
  expect_estimate(series.points[2].axial, 12.0, 1e-9);
  EXPECT_TRUE(std::isnan(series.points[2].axial->sigma_um));
  session.spindle_above = false;
  expect_estimate(drift_of(session).points[2].axial, -12.0, 1e-9);
}

// At h = 20 mm an elongation known to 1 um moves the radius by (h + dL) / R = 0.2 um.
TEST(Drift, RadiusChangeCarriesTheElongationsSigma) {
  VirtualMachine machine = quiet(Method::spindle_rotation);
  machine.bar.noise_um = 1.0;
  machine.height_offset_mm = 20.0;
  machine.truth = {{0.0, 0.0, 0.0, 0.0, 0.0}};
  Session session = simulate(machine).session;
  for (SessionTest& test : session.tests) {
    test.axial_length_mm.reset();
    test.axial = Recording{};
    test.axial->kind = Kind::axial;
    test.axial->length_mm = {100.001, 99.999, 100.0, 100.0015, 99.9985};
  }
  const DriftPoint point = drift_of(session).points[2];
  EXPECT_GT(point.axial->sigma_um, 0.1);
  EXPECT_GT(point.radius_change->sigma_um, 0.2 * point.axial->sigma_um);
  for (SessionTest& test : session.tests) {
    test.axial.reset();
    test.axial_length_mm = 100.0;
  }
  EXPECT_TRUE(std::isnan(drift_of(session).points[2].radius_change->sigma_um)) << "not known, as the elongation's";
}

// One discounted reading leaves the sigma of a change what it was: the form of the path still cancels.
TEST(Drift, ADiscountedReadingDoesNotBringTheFormBack) {
  VirtualMachine machine = quiet(Method::two_arcs);
  machine.bar.noise_um = 0.2;
  machine.truth = {{0.0, 0.0, 0.0, 0.0, 0.0}, {1200.0, 4.0, 30.0, 20.0, 0.0}};
  Session session = simulate(machine).session;
  for (SessionTest& test : session.tests) {
    for (Recording* arc : {&*test.c_arc, &*test.a_arc}) {
      for (std::size_t i = 0; i < arc->length_mm.size(); ++i)
        arc->length_mm[i] += 2e-3 * std::cos(3.0 * arc->angle_rad[i]);
    }
  }
  DriftOptions robust;
  robust.circle.robust = true;
  const double before_um = drift_of(session, robust).points[2].z->sigma_um;
  session.tests[0].a_arc->length_mm[200] += 0.5;
  const double after_um = drift_of(session, robust).points[2].z->sigma_um;
  EXPECT_LT(before_um, 0.1);
  EXPECT_NEAR(after_um, before_um, 0.2 * before_um);
}

TEST(Drift, RefusesTheBallInTwoPlaces) {
  VirtualMachine machine = quiet(Method::circles);
  machine.truth = {{0.0, 0.0, 0.0, 0.0, 0.0}};
  Session session = simulate(machine).session;
  session.tests[0].circles[1].moving_ball = MovingBall::table;
  EXPECT_THROW(drift_of(session), Error);
}

// Plane ZX: A is z, B is x. Linear axes, ball in the spindle: drift has the sign of the centre's change.
TEST(Drift, CirclesUseThePlanesOwnAxes) {
  VirtualMachine machine = quiet(Method::circles);
  machine.plane = Plane::ZX;
  machine.truth = {{0.0, 0.0, 0.0, 0.0, 0.0}, {1200.0, 4.0, 30.0, 20.0, 0.0}};
  const DriftSeries series = drift_of(simulate(machine).session);
  expect_estimate(series.points[2].x, 4.0, 1e-2);
  expect_estimate(series.points[2].z, 20.0, 1e-2);
  EXPECT_FALSE(series.points[2].y.has_value());
}

TEST(Drift, TableBallTurnsTheSign) {
  VirtualMachine machine = quiet(Method::circles);
  machine.truth = {{0.0, 0.0, 0.0, 0.0, 0.0}, {1200.0, 4.0, 30.0, 0.0, 0.0}};
  Session session = simulate(machine).session;
  const double with_spindle_ball_um = drift_of(session).points[2].x->value_um;
  for (SessionTest& test : session.tests) {
    for (Recording& recording : test.circles) recording.moving_ball = MovingBall::table;
  }
  EXPECT_NEAR(drift_of(session).points[2].x->value_um, -with_spindle_ball_um, 1e-9);
}

// Planes taken in turn: each has its own first test, x comes from both.
TEST(Drift, EveryPlaneHasItsOwnReference) {
  VirtualMachine machine = quiet(Method::circles);
  machine.truth = {{0.0, 0.0, 0.0, 0.0, 0.0}, {1200.0, 12.0, 24.0, 36.0, 0.0}};
  machine.test_s = {0.0, 400.0, 800.0, 1200.0};
  Session session = simulate(machine).session;
  machine.plane = Plane::ZX;
  const Session other = simulate(machine).session;
  session.tests[1] = other.tests[1];
  session.tests[3] = other.tests[3];
  const DriftSeries series = drift_of(session);
  expect_estimate(series.points[2].x, 8.0, 1e-2);
  expect_estimate(series.points[2].y, 16.0, 1e-2);
  EXPECT_FALSE(series.points[2].z.has_value());
  expect_estimate(series.points[1].z, 0.0, 0.0);
  expect_estimate(series.points[3].x, 8.0, 1e-2);
  expect_estimate(series.points[3].z, 24.0, 1e-2);
}

// What has nothing to differ from is no drift of 0.
TEST(Drift, ThePlaneOfOneTestHasNone) {
  VirtualMachine machine = quiet(Method::circles);
  machine.truth = {{0.0, 0.0, 0.0, 0.0, 0.0}, {1200.0, 12.0, 24.0, 36.0, 0.0}};
  machine.test_s = {0.0, 400.0, 800.0};
  Session session = simulate(machine).session;
  machine.plane = Plane::ZX;
  session.tests[1] = simulate(machine).session.tests[1];
  const DriftSeries series = drift_of(session);
  EXPECT_FALSE(series.points[1].z.has_value());
  EXPECT_FALSE(series.points[1].x.has_value());
  expect_estimate(series.points[2].x, 8.0, 1e-2);
  EXPECT_NE(text_of(series.not_cancelled).find("One test alone, and so no drift: ZX."), std::string::npos);
  session.tests.resize(2);
  EXPECT_THROW(drift_of(session), Error) << "one of XY, one of ZX";
  session.tests.resize(1);
  EXPECT_NO_THROW(drift_of(session)) << "a position";
}

TEST(Drift, ReferenceIsTheNearestTest) {
  VirtualMachine machine = quiet(Method::circles);
  machine.truth = {{0.0, 0.0, 0.0, 0.0, 0.0}, {1200.0, 4.0, 30.0, 0.0, 0.0}};
  DriftOptions options;
  options.reference_s = 700.0;
  const DriftSeries series = drift_of(simulate(machine).session, options);
  EXPECT_EQ(series.reference_s, 600.0);
  expect_estimate(series.points[0].x, -2.0, 1e-2);
  EXPECT_EQ(series.points[1].x->sigma_um, 0.0);
}

// 95 % intervals of the drift hold the truth: 200 seeds, 3 axes; 600 trials of 95 % scatter by 0.9 %, 4 sigma taken.
TEST(Drift, IntervalsCoverTheTruth) {
  VirtualMachine machine = quiet(Method::two_arcs);
  machine.bar.noise_um = 0.2;
  machine.test_s = {0.0, 1200.0};
  machine.c_arc.readings = 400;
  machine.a_arc.readings = 300;
  machine.truth = {{0.0, 3.0, 2.1, 3.9, 0.0}, {1200.0, 7.4, 32.2, 8.5, 0.0}};
  int covered = 0;
  constexpr int kSeeds = 200;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    machine.seed = seed;
    const DriftPoint point = drift_of(simulate(machine).session).points[1];
    covered += std::abs(point.x->value_um - 4.4) < 1.96 * point.x->sigma_um ? 1 : 0;
    covered += std::abs(point.y->value_um - 30.1) < 1.96 * point.y->sigma_um ? 1 : 0;
    covered += std::abs(point.z->value_um - 4.6) < 1.96 * point.z->sigma_um ? 1 : 0;
  }
  EXPECT_NEAR(covered / (3.0 * kSeeds), 0.95, 0.036);
}

TEST(Drift, SaysWhatATestLacks) {
  VirtualMachine machine = quiet(Method::two_arcs);
  machine.truth = {{0.0, 0.0, 0.0, 0.0, 0.0}};
  Session session = simulate(machine).session;
  session.tests[1].a_arc.reset();
  session.tests[1].name = "01";
  const auto message_of = [](const Session& bad) {
    try {
      drift_of(bad);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  EXPECT_EQ(message_of(session), "test at 600 s (01): two_arcs needs a c_arc and an a_arc recording in every test");
  EXPECT_EQ(message_of(Session{}), "the session has no test; drift needs at least one");
}

}  // namespace
}  // namespace ballbar
