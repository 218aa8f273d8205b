// One diagnosis: BALLBAR_BENCH_DIAGNOSIS_ROWS rows (5000 unless given), none left out, 20 effects searched, 2000 draws.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdlib>
#include <random>

#include "ballbar/diagnosis/verdict/diagnosis.hpp"

namespace {

using namespace ballbar;

// Rows of 15 s: hours of run and rest at several speeds, the body after them, the room in its own time. x moves with
// the speed, which the model has, and with the room, which it has not.
Series made(std::size_t n) {
  Series data;
  Column speed{"speed_rpm", Role::speed, {}}, room{"T_room_degC", Role::ambient, {}},
      body{"T_body_degC", Role::bearing, {}}, load{"P_W", Role::load, {}}, axial{"z_um", Role::structure, {}},
      bar{"T_bar_degC", Role::structure, {}}, target{"x_um", Role::measured, {}};
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  double heat = 0.0, bearing = 0.0, wall = 0.0, memory = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const double t = 15.0 * static_cast<double>(i);
    const double rpm = i % 480 < 240 ? 0.0 : 2000.0 * static_cast<double>(i * 7 / 480 % 5 + 1);
    const double now = 1.5 * std::sin(t / 9000.0) + 0.5 * std::sin(t / 2300.0);
    heat += (std::pow(rpm / 1000.0, 5.0 / 3.0) - heat) * (1.0 - std::exp(-15.0 / 2300.0));
    bearing += (rpm / 1000.0 - bearing) * (1.0 - std::exp(-15.0 / 900.0));
    wall += (now - wall) * (1.0 - std::exp(-15.0 / 1500.0));
    memory = 0.9 * memory + std::sqrt(1.0 - 0.81) * 0.3 * normal(random);
    data.time_s.push_back(t);
    speed.values.push_back(rpm);
    room.values.push_back(20.0 + now + 0.01 * normal(random));
    body.values.push_back(22.0 + bearing + 0.01 * normal(random));
    load.values.push_back(i % 333 < 100 ? 500.0 : 0.0);
    axial.values.push_back(2.0 * bearing + 0.3 * std::sin(t / 4000.0) + 0.05 * normal(random));
    bar.values.push_back(20.0 + 0.3 * std::sin(t / 15000.0) + 0.01 * normal(random));
    target.values.push_back(0.2 * heat + 0.6 * wall + memory + 0.05 * normal(random));
  }
  data.columns = {speed, room, body, load, axial, bar, target};
  return data;
}

void diagnosis(benchmark::State& state) {
  const char* const rows = std::getenv("BALLBAR_BENCH_DIAGNOSIS_ROWS");
  const Series data = made(rows != nullptr ? std::strtoull(rows, nullptr, 10) : 5000);
  Model model;
  model.targets = {"x_um"};
  model.terms = {term_of("speed_heating", {"speed_rpm"})};
  DiagnosisOptions options;
  options.most_rows = data.time_s.size();
  std::size_t searched = 0;
  for (auto _ : state) searched = diagnose(model, data, 0, options).searched_effects;
  state.counters["rows"] = static_cast<double>(data.time_s.size());
  state.counters["effects"] = static_cast<double>(searched);
}

BENCHMARK(diagnosis)->Unit(benchmark::kMillisecond)->UseRealTime()->MeasureProcessCPUTime();

}  // namespace
