// A `.b5r`: read from memory and from disk, and both circles fitted.
#include <benchmark/benchmark.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "ballbar/circle/circle.hpp"
#include "ballbar/formats/recordings/recording_file.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "bench_data.hpp"

namespace {

void b5r_read(benchmark::State& state) {
  const std::string bytes = ballbar::bench::b5r_bytes();
  for (auto _ : state) benchmark::DoNotOptimize(ballbar::read_b5r(bytes, "memory"));
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(bytes.size()));
}

// As an instrument writes it: 3000 readings a run of which half are used, curves, 250 values. About 100 kB.
std::string whole_b5r() {
  ballbar::B5r test = ballbar::read_b5r(ballbar::bench::b5r_bytes(), "memory");
  test.remarks.clear();
  for (const ballbar::Recording& run : test.runs) {
    ballbar::SimulatedCurve curve{run.direction, run.length_mm};
    for (double& value : curve.deviation_um) value = 1000.0 * (value - run.nominal_length_mm);
    test.simulated_um.push_back(std::move(curve));
  }
  for (int i = 0; i < 250; ++i) {
    test.stored.push_back({"RENISHAW_DIAGNOSTICS 2.1", "AF_LATERAL_PLAY_MISMATCH", "UT_LENGTH_UM", 0.1 * i});
  }
  return ballbar::write_b5r(test, 750);
}

void b5r_read_whole(benchmark::State& state) {
  const std::string bytes = whole_b5r();
  for (auto _ : state) benchmark::DoNotOptimize(ballbar::read_b5r(bytes, "memory"));
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(bytes.size()));
}

void b5r_read_and_fit(benchmark::State& state) {
  const std::string bytes = ballbar::bench::b5r_bytes();
  for (auto _ : state) {
    const ballbar::B5r test = ballbar::read_b5r(bytes, "memory");
    for (const ballbar::Recording& run : test.runs) benchmark::DoNotOptimize(ballbar::fit_circle(run));
  }
}

void b5r_open_and_fit(benchmark::State& state) {
  const auto path = std::filesystem::temp_directory_path() / ("ballbar-bench-" + std::to_string(getpid()) + ".b5r");
  ballbar::write_bytes(path, ballbar::bench::b5r_bytes());
  for (auto _ : state) {
    const ballbar::RecordingFile file = ballbar::open_recording(path);
    for (const ballbar::Recording& run : file.recordings) benchmark::DoNotOptimize(ballbar::fit_circle(run));
  }
  std::filesystem::remove(path);
}

BENCHMARK(b5r_read)->Unit(benchmark::kMillisecond);
BENCHMARK(b5r_read_whole)->Unit(benchmark::kMillisecond);
BENCHMARK(b5r_read_and_fit)->Unit(benchmark::kMillisecond);
BENCHMARK(b5r_open_and_fit)->Unit(benchmark::kMillisecond);

}  // namespace
