// One fit: BALLBAR_BENCH_FIT_ROWS rows (5000 unless given), 8 effects with 14 free parameters, noise white or with a
// memory.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdlib>
#include <random>

#include "ballbar/fit/fit.hpp"

namespace {

using namespace ballbar;

Model model() {
  Model model;
  model.targets = {"z_um"};
  model.terms = {term_of("expansion", {"T_body_degC"}),
                 term_of("lagged_expansion", {"T_room_degC"}),
                 term_of("speed_heating", {"speed_rpm"}),
                 term_of("centrifugal_shift", {"speed_rpm"}),
                 term_of("lagged_expansion", {"T_coolant_degC"}),
                 term_of("load_heating", {"P_W"}),
                 term_of("settling", {}),
                 term_of("linear_drift", {})};
  return model;
}

// Rows of 15 s: an hour's run and an hour's rest in turn, the body after it, room and chiller in their own cycles.
Series inputs(std::size_t n) {
  Series data;
  Column speed{"speed_rpm", Role::speed, {}}, room{"T_room_degC", Role::ambient, {}},
      body{"T_body_degC", Role::bearing, {}}, coolant{"T_coolant_degC", Role::coolant, {}}, load{"P_W", Role::load, {}};
  double bearing_degC = 20.0;
  for (std::size_t i = 0; i < n; ++i) {
    const double time_s = 15.0 * static_cast<double>(i);
    const double rpm = i % 480 < 240 ? 0.0 : 2000.0 * static_cast<double>(i / 480 % 5 + 1);
    bearing_degC += (20.0 + rpm / 500.0 - bearing_degC) * 0.01;
    data.time_s.push_back(time_s);
    speed.values.push_back(rpm);
    body.values.push_back(bearing_degC);
    room.values.push_back(20.0 + 2.0 * std::sin(time_s / 9000.0));
    coolant.values.push_back(18.0 + 0.5 * std::sin(time_s / 700.0) + 0.1 * std::sin(time_s / 130.0));
    load.values.push_back(i % 333 < 100 ? 500.0 : 0.0);
  }
  data.columns = {speed, room, body, coolant, load};
  return data;
}

Series measured(double lag_1_correlation) {
  const char* const rows = std::getenv("BALLBAR_BENCH_FIT_ROWS");
  Series data = inputs(rows != nullptr ? std::strtoull(rows, nullptr, 10) : 5000);
  std::vector<FittedParameter> truth(1);
  for (const Term& term : model().terms) {
    for (const Parameter& parameter : term.effect->parameters) {
      const bool shape = parameter.kind == ParameterKind::shape && !parameter.held && !parameter.grid.empty();
      FittedParameter value;
      value.value = parameter.kind == ParameterKind::gain ? 1.0
                    : shape                               ? 1.2 * parameter.grid[parameter.grid.size() / 2]
                                                          : parameter.start;
      truth.push_back(value);
    }
  }
  std::vector<double> target = predict(model(), truth, data).predicted_um;
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  double memory = 0.0;
  for (double& value : target) {
    memory = lag_1_correlation * memory + std::sqrt(1.0 - lag_1_correlation * lag_1_correlation) * normal(random);
    value += 0.5 * memory + 0.1 * normal(random);
  }
  data.columns.push_back({"z_um", Role::measured, std::move(target)});
  return data;
}

void fit_of(benchmark::State& state, double lag_1_correlation, const FitOptions& options) {
  const Series data = measured(lag_1_correlation);
  for (auto _ : state) benchmark::DoNotOptimize(fit(model(), data, 0, options).rmse_um);
  state.counters["rows"] = static_cast<double>(data.time_s.size());
}

void fit_white(benchmark::State& state) { fit_of(state, 0.0, {.white = true}); }
void fit_with_noise(benchmark::State& state) { fit_of(state, 0.0, {}); }
void fit_with_memory(benchmark::State& state) { fit_of(state, 0.9, {}); }
void fit_robust(benchmark::State& state) { fit_of(state, 0.9, {.robust = true}); }

BENCHMARK(fit_white)->Unit(benchmark::kMillisecond);
BENCHMARK(fit_with_noise)->Unit(benchmark::kMillisecond);
BENCHMARK(fit_with_memory)->Unit(benchmark::kMillisecond);
BENCHMARK(fit_robust)->Unit(benchmark::kMillisecond);

}  // namespace
