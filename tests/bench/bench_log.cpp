// A long ballbar log, read from memory. Its size: BALLBAR_BENCH_LOG_MB, 50 unless given.
#include <benchmark/benchmark.h>

#include <cstdlib>

#include "ballbar/formats/recordings/ballbar_log.hpp"
#include "bench_data.hpp"

namespace {

void log_read(benchmark::State& state) {
  const char* const size_MB = std::getenv("BALLBAR_BENCH_LOG_MB");
  const std::string bytes = ballbar::bench::log_bytes((size_MB ? std::strtoull(size_MB, nullptr, 10) : 50) * 1'000'000);
  std::size_t readings = 0;
  for (auto _ : state) {
    const ballbar::Recording recording = ballbar::read_ballbar_log(bytes, "memory");
    readings = recording.length_mm.size();
    benchmark::DoNotOptimize(readings);
  }
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(bytes.size()));
  state.counters["readings"] = static_cast<double>(readings);
}

BENCHMARK(log_read)->Unit(benchmark::kMillisecond);

}  // namespace
