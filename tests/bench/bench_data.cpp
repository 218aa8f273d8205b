#include "bench_data.hpp"

#include <cmath>
#include <random>
#include <utility>

#include "ballbar/formats/recordings/ballbar_log.hpp"

namespace ballbar::bench {
namespace {

VirtualMachine circles_machine(std::size_t readings) {
  VirtualMachine machine;
  machine.method = Method::circles;
  machine.truth = {{.time_s = 0.0, .x_um = 12.0, .y_um = -7.0}};
  machine.test_s = {0.0};
  machine.circle.readings = readings;
  machine.seed = 1;
  return machine;
}

}  // namespace

Recording circle_of(std::size_t readings) {
  return std::move(simulate(circles_machine(readings)).session.tests.at(0).circles.at(0));
}

std::string b5r_bytes() {
  B5r test;
  test.test_name = "benchmark";
  test.ballbar_model = "simulated";
  test.software_version = "0";
  test.runs = std::move(simulate(circles_machine(1500)).session.tests.at(0).circles);
  for (Recording& run : test.runs) {
    run.started_s = 1'425'286'800;  // 2015-03-02T09:00:00
    run.feed_mm_per_min = 1000.0;
  }
  return write_b5r(test);
}

std::string b5r_of_week(int week) {
  VirtualMachine machine = circles_machine(1500);
  machine.seed = static_cast<std::uint64_t>(week + 1);
  machine.plane = week % 3 == 0 ? Plane::XY : week % 3 == 1 ? Plane::YZ : Plane::ZX;
  machine.bar.noise_um = 0.1;
  machine.backlash_a_um = 1.0 + 0.01 * week;
  B5r test;
  test.test_name = "benchmark";
  test.runs = std::move(simulate(machine).session.tests.at(0).circles);
  for (Recording& run : test.runs) {
    run.started_s = 1'425'286'800 + 604'800 * static_cast<std::int64_t>(week);
    run.feed_mm_per_min = 1000.0;
  }
  return write_b5r(test);
}

std::string log_bytes(std::size_t size) {
  constexpr std::size_t kTurn = 100'000;
  Recording turn = circle_of(kTurn);
  turn.time_s.clear();
  const std::size_t turns = size / write_ballbar_log(turn).size() + 1;
  Recording log = turn;
  for (std::size_t i = 1; i < turns; ++i) {
    log.angle_rad.insert(log.angle_rad.end(), turn.angle_rad.begin(), turn.angle_rad.end());
    log.length_mm.insert(log.length_mm.end(), turn.length_mm.begin(), turn.length_mm.end());
  }
  return write_ballbar_log(log);
}

Series five_probe_series(std::size_t rows) {
  constexpr double kStep_s = 15.0, kWarmUp_s = 7200.0, kNoise_um = 0.1;
  constexpr std::array<double, 5> kGain_um{5.0, 7.0, 30.0, 24.0, 40.0};
  std::mt19937_64 random(3);
  std::normal_distribution<double> noise(0.0, kNoise_um);
  Series series;
  series.five_probe = FiveProbe{};
  series.five_probe->spacing_mm = 80.0;
  series.five_probe->resolution_um = 0.01;
  for (const std::string& name : series.five_probe->columns) series.columns.push_back({name, Role::measured, {}});
  for (std::size_t row = 0; row < rows; ++row) {
    series.time_s.push_back(kStep_s * static_cast<double>(row));
    const double warm = 1.0 - std::exp(-series.time_s.back() / kWarmUp_s);
    for (std::size_t i = 0; i < kGain_um.size(); ++i) {
      series.columns[i].values.push_back(std::round(100.0 * (kGain_um[i] * warm + noise(random))) / 100.0);
    }
  }
  return series;
}

std::vector<Series> warm_ups(std::size_t count) {
  constexpr std::size_t kRows = 600, kSensors = 24;
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform;
  std::normal_distribution<double> noise;
  std::vector<Series> all(count);
  for (Series& series : all) {
    const double room = 10.0 + 20.0 * uniform(random), heat_K = 15.0 + 20.0 * uniform(random);
    for (std::size_t j = 0; j + 1 < kSensors; ++j) series.columns.push_back({"T" + std::to_string(j + 1) + "_degC"});
    series.columns.push_back({"T_room_degC"});
    series.columns.push_back({"z_um", Role::measured});
    for (std::size_t i = 0; i < kRows; ++i) {
      const double time_s = 30.0 * static_cast<double>(i);
      const double fast = heat_K * (1.0 - std::exp(-time_s / 1800.0)),
                   slow = heat_K * (1.0 - std::exp(-time_s / 7200.0));
      series.time_s.push_back(time_s);
      for (std::size_t j = 0; j < kSensors; ++j) {
        const bool is_room = j + 1 == kSensors;
        const double a = is_room ? 0.0 : 0.1 + 0.9 * static_cast<double>(j * 7 % 23) / 22.0;
        const double b = is_room ? 0.0 : 0.3 * static_cast<double>(j * 5 % 23) / 22.0;
        const double degC = room + a * fast + b * slow + 0.05 * noise(random);
        series.columns[j].values.push_back(std::round(10.0 * degC) / 10.0);
      }
      series.columns.back().values.push_back(0.04 * room * fast + 0.3 * slow + 0.5 * noise(random));
    }
  }
  return all;
}

SimulatedSession two_arc_session() {
  VirtualMachine machine;
  machine.method = Method::two_arcs;
  machine.truth = {{.time_s = 0.0}, {.time_s = 14'400.0, .x_um = 6.0, .y_um = -4.0, .z_um = 35.0}};
  for (int test = 0; test < 15; ++test) machine.test_s.push_back(960.0 * test);
  machine.seed = 2;
  return simulate(machine);
}

}  // namespace ballbar::bench
