// A program of someone else's, built against the installed package: five tasks of the library, on readings made here,
// and a log from a string. Each task returns whether it found what the readings hold.
#include <ballbar/circle/circle.hpp>
#include <ballbar/diagnosis/verdict/diagnose.hpp>
#include <ballbar/drift/compare.hpp>
#include <ballbar/drift/drift.hpp>
#include <ballbar/error.hpp>
#include <ballbar/fit/fit.hpp>
#include <ballbar/formats/recordings/ballbar_log.hpp>
#include <ballbar/units.hpp>
#include <ballbar/workbench/workbench.hpp>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <memory>

namespace {

// A full circle of 100 mm, whose centre is 5 um and `more_um` along A.
ballbar::Recording readings_of_circle(double more_um) {
  ballbar::Recording recording;
  for (int degree = 0; degree < 360; ++degree) {
    const double angle_rad = ballbar::rad_from_deg(degree);
    recording.angle_rad.push_back(angle_rad);
    recording.length_mm.push_back(100.0 + 0.001 * (5.0 + more_um) * std::cos(angle_rad));
  }
  return recording;
}

// 10 h of a spindle that grows 2 um for each kelvin of its bearing, read every 3 min with about 0.2 um of noise.
ballbar::Series spindle_log() {
  ballbar::Series log;
  log.columns = {{"T_bearing_degC", ballbar::Role::bearing, {}}, {"Z_um", ballbar::Role::measured, {}}};
  std::uint32_t random = 1;
  for (int row = 0; row < 200; ++row) {
    random = 1664525u * random + 1013904223u;
    const double noise_um = 0.7 * (random / 4294967296.0 - 0.5);
    log.time_s.push_back(180.0 * row);
    const double rise_K = 6.0 * (1.0 - std::exp(-row / 20.0)) + std::sin(row / 9.0);
    log.columns[0].values.push_back(21.0 + rise_K);
    log.columns[1].values.push_back(2.0 * rise_K + noise_um);
  }
  return log;
}

bool circle() {
  const ballbar::Recording recording = readings_of_circle(0.0);
  const ballbar::Circle circle = ballbar::fit_circle(recording);
  std::cout << "centre a " << circle.centre_a_um << " um, sigma " << circle.sigma_centre_a_um() << " um\n";
  // 5 um of offset on a 100 mm bar: the second order of the length equation is 0.1 nm.
  return std::abs(circle.centre_a_um - 5.0) < 1e-3;
}

// Tests after 0, 1 and 2 h, between which the centre moves by 3 um an hour.
ballbar::Session session() {
  ballbar::Session session;
  for (int hour = 0; hour < 3; ++hour) {
    ballbar::SessionTest test;
    test.elapsed_s = 3600.0 * hour;
    test.circles = {readings_of_circle(3.0 * hour)};
    session.tests.push_back(test);
  }
  return session;
}

bool drift() {
  const ballbar::DriftSeries drift = ballbar::drift_of(session());
  const ballbar::Estimate x = drift.points.back().x.value();
  std::cout << "drift of X after 2 h " << x.value_um << " um\n";
  return std::abs(x.value_um - 6.0) < 1e-2;
}

bool comparison() {
  ballbar::Series probes;
  probes.time_s = {0.0, 3600.0, 7200.0};
  probes.columns = {{"x_um", ballbar::Role::measured, {0.0, 3.1, 6.2}},
                    {"x_sigma_um", ballbar::Role::measured, {0.2, 0.2, 0.2}}};
  const ballbar::Session tests = session();
  const ballbar::Comparison comparison =
      ballbar::compare(ballbar::measured(ballbar::drift_of(tests), tests), ballbar::measured(probes, "probes"));
  std::cout << "ballbar less probes, X: " << comparison.axes.front().rmse << " um RMS\n";
  return comparison.axes.front().agreement == ballbar::Agreement::agrees;
}

bool fit_and_where_it_fails() {
  const ballbar::Series log = spindle_log();
  ballbar::Model constant;
  constant.targets = {"Z_um"};
  const ballbar::Fit fit = ballbar::fit(constant, log);
  const std::vector<ballbar::Misfit> where = ballbar::where_it_fails(fit, log);
  std::cout << "a constant leaves " << fit.rmse_um << " um, most where " << ballbar::worst_place(fit, where)->what
            << " is from " << ballbar::worst_place(fit, where)->from << '\n';
  return fit.rmse_um > 1.0 && !ballbar::is_adequate(fit, ballbar::whiteness(fit));
}

bool diagnose_and_add() {
  ballbar::Model constant;
  constant.targets = {"Z_um"};
  ballbar::Workbench bench(std::make_shared<const ballbar::Series>(spindle_log()), constant);
  const ballbar::Diagnosis& found = bench.diagnosis();
  if (found.verdict != ballbar::Verdict::named) return false;
  const ballbar::BoundEffect missing = found.named.front();
  bench.add({ballbar::term_of(*missing.effect, missing.columns)});
  const ballbar::EffectTest& test = bench.added();
  std::cout << label_of(missing) << ": " << test.before.rmse_um << " um before, " << test.after.rmse_um << " after\n";
  return test.after.rmse_um < 0.3;
}

bool log_from_text() {
  const ballbar::Recording log = ballbar::read_ballbar_log(
      "# format = \"ballbar-log 1\"\n# kind = \"axial\"\n# nominal_length_mm = 100.0\n"
      "time_s,length_mm\n0.0,99.9990\n1.0,99.9991\n",
      "in-code.csv");
  try {
    ballbar::read_ballbar_log("time_s\n", "bad.csv");
    return false;
  } catch (const ballbar::Error& error) {
    std::cout << error.what() << '\n';
  }
  return log.length_mm.size() == 2 && log.length_mm[1] == 99.9991;
}

}  // namespace

int main() {
  const bool found =
      circle() & drift() & comparison() & fit_and_where_it_fails() & diagnose_and_add() & log_from_text();
  return found ? 0 : 1;
}
