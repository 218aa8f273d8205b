// Batches of thermal tests in memory: their moments, and their weights for a job. Their number:
// BALLBAR_BENCH_BATCHES, 1000 unless given.
#include <benchmark/benchmark.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "ballbar/internal/predict/batch_weights.hpp"
#include "bench_data.hpp"

namespace {

const std::vector<ballbar::Series>& warm_ups() {  // made once: seconds
  static const char* const stated = std::getenv("BALLBAR_BENCH_BATCHES");
  static const std::vector<ballbar::Series> all =
      ballbar::bench::warm_ups(stated ? std::strtoull(stated, nullptr, 10) : 1000);
  return all;
}

ballbar::BatchColumns columns() {
  return ballbar::batch_columns(warm_ups().front(), ballbar::InputKind::temperature, "z_um", {});
}

std::vector<ballbar::Batch> batches() {
  const ballbar::BatchColumns all = columns();
  std::vector<ballbar::Batch> result;
  for (const ballbar::Series& series : warm_ups()) {
    result.push_back(ballbar::batch_of(std::to_string(result.size()), series, all));
  }
  return result;
}

void batches_moments(benchmark::State& state) {
  state.counters["batches"] = static_cast<double>(warm_ups().size());  // made here, before the clock runs
  for (auto _ : state) benchmark::DoNotOptimize(batches());
}

void batches_weighted(benchmark::State& state) {
  const std::vector<ballbar::Batch> all = batches();
  const std::span<const ballbar::Batch> others(all.data(), all.size() - 1);
  for (auto _ : state) {
    benchmark::DoNotOptimize(ballbar::batch_weights(others, all.back().start, ballbar::RegressionMethod::pcr));
  }
  state.counters["batches"] = static_cast<double>(warm_ups().size());
}

// The processor time of all threads.
BENCHMARK(batches_moments)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();
BENCHMARK(batches_weighted)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();

}  // namespace
