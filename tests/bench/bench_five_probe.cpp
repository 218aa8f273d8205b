// A long recording of five probes end to end: read from disk, reduced to drift and tilt, written as .csv. Its rows:
// BALLBAR_BENCH_ROWS, a million unless given.
#include <benchmark/benchmark.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "ballbar/drift/five_probes.hpp"
#include "ballbar/formats/series/drift_files.hpp"
#include "ballbar/formats/series/series_csv.hpp"
#include "ballbar/formats/sessions/drift_data.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "bench_data.hpp"

namespace {

namespace fs = std::filesystem;

std::size_t rows() {
  const char* const stated = std::getenv("BALLBAR_BENCH_ROWS");
  return stated ? std::strtoull(stated, nullptr, 10) : 1'000'000;
}

ballbar::FivePointOptions at_the_ball() {
  ballbar::FivePointOptions how;
  how.from_plane_1_mm = 25.0;
  return how;
}

void five_probe_file(benchmark::State& state) {
  const fs::path scratch = fs::temp_directory_path() / ("ballbar-bench-" + std::to_string(getpid()));
  fs::create_directories(scratch);
  ballbar::write_bytes(scratch / "probes.csv", ballbar::write_series(ballbar::bench::five_probe_series(rows())));
  for (auto _ : state) {
    const ballbar::Series series = ballbar::open_series(scratch / "probes.csv");
    const ballbar::FivePoint found = ballbar::five_point(series, at_the_ball());
    ballbar::write_drift(found.drift, {}, {}, scratch / "drift.csv");
  }
  state.counters["rows"] = static_cast<double>(rows());
  fs::remove_all(scratch);
}

void five_probe_reduced(benchmark::State& state) {
  const ballbar::Series series = ballbar::bench::five_probe_series(rows());
  for (auto _ : state) benchmark::DoNotOptimize(ballbar::five_point(series, at_the_ball()));
  state.counters["rows"] = static_cast<double>(rows());
}

BENCHMARK(five_probe_file)->Unit(benchmark::kMillisecond);
BENCHMARK(five_probe_reduced)->Unit(benchmark::kMillisecond);

}  // namespace
