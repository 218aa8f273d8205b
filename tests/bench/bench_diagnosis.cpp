// One diagnosis: 1333 rows of 5 inputs, 6669 rows of 16 temperatures and a speed, 5000 rows of 6 inputs; with the rows
// that a diagnosis weighs (1000), and with all of them; three runs of 1500 rows. The design of the next test.
#include <benchmark/benchmark.h>

#include <cmath>
#include <random>
#include <string>

#include "ballbar/diagnosis/next_test/plan.hpp"
#include "ballbar/diagnosis/verdict/diagnose.hpp"
#include "ballbar/internal/model/run_terms.hpp"
#include "ballbar/series/series.hpp"

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

// The same rows of 25 s with 16 temperatures in the place of its own: bodies behind heat and room, each in its own
// time.
Series of_temperatures(std::size_t n) {
  Series data = made(n);
  const std::vector<double> heat = data.columns[2].values, room = data.columns[1].values;
  data.columns = {data.columns.front(), data.columns.back()};
  std::mt19937_64 random(2);
  std::normal_distribution<double> normal;
  for (double& t : data.time_s) t *= 25.0 / 15.0;
  for (int k = 0; k < 16; ++k) {
    Column one{"T" + std::to_string(k + 1) + "_degC", k == 15 ? Role::ambient : Role::structure, {}};
    const double share = 1.0 - std::exp(-25.0 / (200.0 * std::pow(1.3, k))), warm = 1.0 - k / 15.0;
    double value = room[0];
    for (std::size_t i = 0; i < n; ++i) {
      value += share * (room[i] + warm * (heat[i] - 22.0) - value);
      one.values.push_back(value + 0.01 * normal(random));
    }
    data.columns.insert(data.columns.end() - 1, one);
  }
  return data;
}

Model believed() {
  Model model;
  model.targets = {"x_um"};
  model.terms = {term_of("speed_heating", {"speed_rpm"})};
  return model;
}

void diagnosed(benchmark::State& state, const Series& data, bool all) {
  const Model model = with_run_terms(believed(), data);
  DiagnosisOptions options;
  if (all) options.most_rows = data.time_s.size();
  Diagnosis found;
  for (auto _ : state) found = diagnose(model, data, 0, options);
  state.SetLabel(std::string(name_of(found.verdict)));
  state.counters["rows"] = static_cast<double>(data.time_s.size());
  state.counters["inputs"] = static_cast<double>(data.columns.size() - 1);
}

void diagnosis_1333_rows_5_inputs(benchmark::State& state) {
  Series data = made(1333);
  data.columns.erase(data.columns.begin() + 4);  // z_um
  diagnosed(state, data, false);
}

void diagnosis_6669_rows_16_temperatures(benchmark::State& state) { diagnosed(state, of_temperatures(6669), false); }

void diagnosis_5000_rows(benchmark::State& state) { diagnosed(state, made(5000), false); }

void diagnosis_5000_rows_all(benchmark::State& state) { diagnosed(state, made(5000), true); }

// Three parts of one record, each from its own zero.
Series three_runs() {
  const Series all = made(4500);
  std::vector<Series> runs;
  for (std::size_t run = 0; run < 3; ++run) runs.push_back(rows_of(all, {1500 * run, 1500 * (run + 1)}));
  return stacked(runs, {"one", "two", "three"}).series;
}

void diagnosis_three_runs_of_1500_rows(benchmark::State& state) { diagnosed(state, three_runs(), false); }

void test_plan_of_12_h(benchmark::State& state) {
  const Series data = made(700);
  const Model model = believed();
  for (auto _ : state) benchmark::DoNotOptimize(test_plan(model, data, 0, {}));
}

BENCHMARK(diagnosis_1333_rows_5_inputs)->Unit(benchmark::kMillisecond)->UseRealTime()->MeasureProcessCPUTime();
BENCHMARK(diagnosis_6669_rows_16_temperatures)->Unit(benchmark::kMillisecond)->UseRealTime()->MeasureProcessCPUTime();
BENCHMARK(diagnosis_5000_rows)->Unit(benchmark::kMillisecond)->UseRealTime()->MeasureProcessCPUTime();
BENCHMARK(diagnosis_three_runs_of_1500_rows)->Unit(benchmark::kMillisecond)->UseRealTime()->MeasureProcessCPUTime();
BENCHMARK(test_plan_of_12_h)->Unit(benchmark::kMillisecond)->UseRealTime()->MeasureProcessCPUTime()->Iterations(1);
BENCHMARK(diagnosis_5000_rows_all)->Unit(benchmark::kMillisecond)->UseRealTime()->MeasureProcessCPUTime();

}  // namespace
