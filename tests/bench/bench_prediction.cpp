// A regression on effects: trained on one warm-up of 600 rows and 24 temperatures; a row predicted live, and a series.
#include <benchmark/benchmark.h>

#include <cstdint>
#include <vector>

#include "ballbar/predict/train.hpp"
#include "bench_data.hpp"

namespace {

const ballbar::Series& warm_up() {
  static const ballbar::Series series = ballbar::bench::warm_ups(1).front();
  return series;
}

ballbar::EffectRegression trained() {
  ballbar::EffectRegressionOptions options;
  options.forecasts = false;
  return ballbar::effect_regression({&warm_up(), 1}, "z_um", options);
}

void prediction_trained(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(trained());
}

void prediction_live_row(benchmark::State& state) {
  const ballbar::EffectRegression regression = trained();
  ballbar::LivePrediction live(regression);
  std::vector<double> values;
  for (const std::string& name : live.columns()) values.push_back(find_column(warm_up(), name)->values.front());
  double time_s = 0.0;
  for (auto _ : state) {
    time_s += 15.0;
    values.front() += 0.001;
    benchmark::DoNotOptimize(live.next(time_s, values));
  }
  state.counters["terms"] = static_cast<double>(regression.model.terms.size());
}

// A series of 100 000 rows, in rows a second.
void prediction_of_series(benchmark::State& state) {
  const ballbar::EffectRegression regression = trained();
  ballbar::Series series = warm_up();
  const std::size_t rows = 100'000, known = series.time_s.size();
  for (std::size_t i = known; i < rows; ++i) series.time_s.push_back(series.time_s.back() + 15.0);
  for (ballbar::Column& column : series.columns) {
    column.values.resize(rows);
    for (std::size_t i = known; i < rows; ++i) column.values[i] = column.values[i - known];
  }
  for (auto _ : state) benchmark::DoNotOptimize(predict(regression, series));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(rows));
  state.counters["terms"] = static_cast<double>(regression.model.terms.size());
}

BENCHMARK(prediction_trained)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();
BENCHMARK(prediction_live_row)->Unit(benchmark::kMicrosecond);
BENCHMARK(prediction_of_series)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
