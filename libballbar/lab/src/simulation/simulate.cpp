#include "ballbar/lab/simulation/simulate.hpp"

#include <fmt/core.h>

#include <Eigen/Geometry>
#include <cmath>

#include "ballbar/error.hpp"
#include "ballbar/units.hpp"
#include "numerics/random_streams.hpp"
#include "simulation/simulate_parts.hpp"

namespace ballbar {
namespace {

using Eigen::AngleAxisd;
using Eigen::Isometry3d;
using Eigen::Translation3d;
using Eigen::Vector3d;

struct Balls {
  Isometry3d spindle;
  Isometry3d table;
};

Translation3d shift_mm(const Vector3d& shift_um) { return Translation3d(shift_um / 1e3); }

double path_radius_mm(const VirtualMachine& machine) {
  return machine.bar.nominal_length_mm + mm_from_um(machine.bar.radius_error_um);
}

Vector3d setup_um(const VirtualMachine& machine) {
  return {machine.setup_x_um, machine.setup_y_um, machine.setup_z_um};
}

Vector3d drift_um(const TruePosition& truth) { return {truth.x_um, truth.y_um, truth.z_um}; }

// machine -> A -> C -> table's ball;  machine -> spindle's ball.
Balls five_axis(const VirtualMachine& machine, const TruePosition& truth, double a_rad, double c_rad) {
  const Isometry3d table = AngleAxisd(a_rad, Vector3d::UnitX()) * AngleAxisd(c_rad, Vector3d::UnitZ()) *
                           Translation3d(path_radius_mm(machine), 0.0, machine.height_offset_mm);
  return {Isometry3d(shift_mm(setup_um(machine) + drift_um(truth))), table};
}

Balls on_path_about_c(const VirtualMachine& machine, const TruePosition& truth, double theta_rad) {
  return five_axis(machine, truth, 0.0, theta_rad);
}

// With C at 90 deg the table's ball is at (0, R, h): it starts at atan(h / R) above +Y, and A adds to that.
Balls on_path_about_a(const VirtualMachine& machine, const TruePosition& truth, double theta_rad) {
  const double start_rad = std::atan2(machine.height_offset_mm, path_radius_mm(machine));
  return five_axis(machine, truth, theta_rad - start_rad, kPi / 2.0);
}

// machine -> axis A -> axis B -> spindle -> spindle's ball;  the table's ball is the origin.
Balls linear_axes(const VirtualMachine& machine, const TruePosition& truth, double theta_rad, Direction direction) {
  const auto [a, b] = axes_of(machine.plane);
  const Vector3d along_a = Vector3d::Unit(a), along_b = Vector3d::Unit(b);
  const double radius_mm = path_radius_mm(machine);
  const double scale = mm_from_um(machine.harmonic2_um) / radius_mm;
  const double velocity_a = -std::sin(theta_rad) * (direction == Direction::CCW ? 1.0 : -1.0);
  const double play_mm = mm_from_um(machine.backlash_a_um) * (velocity_a < 0.0 ? 0.5 : -0.5);
  const double a_mm = radius_mm * std::cos(theta_rad) * (1.0 + scale) + play_mm;
  const double b_mm = radius_mm * std::sin(theta_rad) * (1.0 - scale);
  const Isometry3d spindle = Translation3d(a_mm * along_a) * Translation3d(b_mm * along_b) *
                             shift_mm(setup_um(machine) + drift_um(truth)) *
                             Isometry3d(Translation3d(machine.height_offset_mm * along_a.cross(along_b)));
  return {spindle, Isometry3d::Identity()};
}

// machine -> spindle's axis -> turn -> spindle's ball;  the table's ball stands.
Balls turning_spindle(const VirtualMachine& machine, const TruePosition& truth, double theta_rad) {
  const Vector3d axis_um(-truth.along_bar_um, 0.0, -truth.z_um - machine.setup_z_um);
  const Vector3d centre_um(machine.setup_x_um + machine.run_out_um + truth.x_um, machine.setup_y_um + truth.y_um, 0.0);
  const Isometry3d spindle = shift_mm(axis_um) * AngleAxisd(-theta_rad, Vector3d::UnitZ()) * shift_mm(-centre_um);
  return {spindle, Isometry3d(Translation3d(path_radius_mm(machine), 0.0, machine.height_offset_mm))};
}

// machine -> spindle -> spindle's ball;  the table's second mount is the origin.
Balls standing_bar(const VirtualMachine& machine, const TruePosition& truth) {
  const double length_mm = machine.bar.nominal_length_mm + mm_from_um(machine.axial.offset_um);
  const Isometry3d spindle = Translation3d(0.0, 0.0, machine.spindle_above ? length_mm : -length_mm) *
                             Isometry3d(shift_mm({-truth.along_bar_um, 0.0, -truth.z_um}));
  return {spindle, Isometry3d::Identity()};
}

// What the bar reads of true lengths, in the order of time.
class Bar {
 public:
  Bar(const VirtualMachine& machine, simulation::Stream kind, double test_s)
      : machine_(machine),
        random_(simulation::stream_of(machine.seed, kind, simulation::key_of(test_s))),
        noise_um_(machine.bar.noise_um, machine.bar.autocorrelation) {}

  double reading_mm(const Balls& balls) {
    const VirtualBar& bar = machine_.bar;
    const double true_mm = (balls.spindle.translation() - balls.table.translation()).norm();
    const bool outlier = simulation::uniform(random_) < bar.outlier_share;
    const double error_um = noise_um_.next(random_) + (outlier ? bar.outlier_um : 0.0);
    const double length_mm = simulation::rounded(true_mm + mm_from_um(error_um), mm_from_um(bar.resolution_um));
    if (!(length_mm > 0.0)) {
      throw Error(fmt::format("{}: the two balls meet: a reading comes to {} mm, and a length must be above 0.",
                              machine_.name, length_mm));
    }
    return length_mm;
  }

 private:
  const VirtualMachine& machine_;
  std::mt19937_64 random_;
  simulation::Ar1 noise_um_;
};

Recording blank(const VirtualMachine& machine, double test_s) {
  Recording recording;
  recording.nominal_length_mm = machine.bar.nominal_length_mm;
  recording.elapsed_s = test_s;
  if (machine.started_s) recording.started_s = *machine.started_s + std::llround(test_s);
  return recording;
}

// `balls_at` gives the balls at an angle, rad.
template <typename BallsAt>
Recording circle(const VirtualMachine& machine, double test_s, const Sweep& sweep, simulation::Stream kind,
                 const BallsAt& balls_at) {
  Recording recording = blank(machine, test_s);
  recording.feed_mm_per_min = machine.feed_mm_per_min;
  recording.direction = sweep.end_deg > sweep.start_deg ? Direction::CCW : Direction::CW;
  const double arc_deg = sweep.end_deg - sweep.start_deg;
  const double sweep_s = path_radius_mm(machine) * rad_from_deg(std::abs(arc_deg)) / machine.feed_mm_per_min * 60.0;
  Bar bar(machine, kind, test_s);
  for (std::size_t i = 0; i < sweep.readings; ++i) {
    const double share = (static_cast<double>(i) + 0.5) / static_cast<double>(sweep.readings);
    const double theta_rad = rad_from_deg(simulation::rounded(sweep.start_deg + share * arc_deg, 1e-9));
    recording.time_s.push_back(simulation::rounded(share * sweep_s, 1e-6));
    recording.angle_rad.push_back(theta_rad);
    recording.length_mm.push_back(bar.reading_mm(balls_at(theta_rad)));
  }
  return recording;
}

void two_arcs(const VirtualMachine& machine, const TruePosition& truth, SessionTest& test) {
  using simulation::Stream;
  test.c_arc = circle(machine, test.elapsed_s, machine.c_arc, Stream::c_arc,
                      [&](double theta_rad) { return on_path_about_c(machine, truth, theta_rad); });
  test.a_arc = circle(machine, test.elapsed_s, machine.a_arc, Stream::a_arc,
                      [&](double theta_rad) { return on_path_about_a(machine, truth, theta_rad); });
  for (Recording* arc : {&*test.c_arc, &*test.a_arc}) {
    arc->motion = Motion::rotary_axis;
    arc->moving_ball = MovingBall::table;
  }
  test.c_arc->height_offset_mm = machine.height_offset_mm;
  test.a_arc->plane = Plane::YZ;
}

void circles(const VirtualMachine& machine, const TruePosition& truth, SessionTest& test) {
  const Sweep back{machine.circle.end_deg, machine.circle.start_deg, machine.circle.readings};
  for (const Sweep& sweep : {machine.circle, back}) {
    const Direction direction = sweep.end_deg > sweep.start_deg ? Direction::CCW : Direction::CW;
    const auto kind = direction == Direction::CCW ? simulation::Stream::ccw : simulation::Stream::cw;
    Recording recording = circle(machine, test.elapsed_s, sweep, kind,
                                 [&](double theta_rad) { return linear_axes(machine, truth, theta_rad, direction); });
    recording.plane = machine.plane;
    recording.height_offset_mm = machine.height_offset_mm;
    test.circles.push_back(std::move(recording));
  }
}

void spindle_rotation(const VirtualMachine& machine, const TruePosition& truth, SessionTest& test) {
  test.rotation = circle(machine, test.elapsed_s, machine.circle, simulation::Stream::rotation,
                         [&](double theta_rad) { return turning_spindle(machine, truth, theta_rad); });
  test.rotation->motion = Motion::spindle;
  test.rotation->moving_ball = MovingBall::table;
  test.rotation->height_offset_mm = machine.height_offset_mm;
  const Balls balls = standing_bar(machine, truth);
  Bar bar(machine, simulation::Stream::axial, test.elapsed_s);
  if (machine.axial.readings == 0) {
    test.axial_length_mm = bar.reading_mm(balls);
    return;
  }
  test.axial = blank(machine, test.elapsed_s);
  test.axial->kind = Kind::axial;
  for (std::size_t i = 0; i < machine.axial.readings; ++i) {
    test.axial->time_s.push_back(simulation::rounded(static_cast<double>(i) * machine.axial.interval_s, 1e-6));
    test.axial->length_mm.push_back(bar.reading_mm(balls));
  }
}

SimulatedSession session_of(const VirtualMachine& machine) {
  simulation::check(machine);
  SimulatedSession simulated;
  Session& session = simulated.session;
  session.method = machine.method;
  session.title = machine.title;
  session.nominal_length_mm = machine.bar.nominal_length_mm;
  session.spindle_above = machine.spindle_above;
  for (const double test_s : machine.test_s) {
    const TruePosition truth = simulation::truth_at(machine, test_s);
    SessionTest test;
    test.elapsed_s = test_s;
    test.name = fmt::format("test {}", session.tests.size());
    switch (machine.method) {
      case Method::two_arcs:
        two_arcs(machine, truth, test);
        break;
      case Method::circles:
        circles(machine, truth, test);
        break;
      case Method::spindle_rotation:
        spindle_rotation(machine, truth, test);
        break;
    }
    session.tests.push_back(std::move(test));
  }
  simulated.signals = simulation::signals_of(machine);
  simulated.five_probe = simulation::five_probe_of(machine);
  simulated.ball_from_plane_1_mm = machine.five_probe.ball_offset_mm;
  simulated.truth = simulation::truth_of(machine);
  return simulated;
}

}  // namespace

SimulatedSession simulate(const VirtualMachine& machine) {
  if (machine.series) return simulation::series_of(machine);
  if (!machine.spindle) return session_of(machine);
  const VirtualSpindle& spindle = *machine.spindle;
  const ThermalRun run = run_of(spindle.body, spindle.plan, spindle.mechanisms, spindle.clock);
  SimulatedSession simulated = session_of(simulation::moved_by(machine, run));
  for (Column& cause : simulation::causes_at_tests(machine, run)) {
    simulated.truth.columns.push_back(std::move(cause));
  }
  simulated.profiles = run.profiles;
  return simulated;
}

}  // namespace ballbar
