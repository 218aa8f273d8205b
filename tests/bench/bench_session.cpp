// A warm-up series end to end: 15 tests of two arcs read from disk, and their drift.
#include <benchmark/benchmark.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "ballbar/drift/drift.hpp"
#include "ballbar/formats/sessions/session_toml.hpp"
#include "bench_data.hpp"
#include "simulate/simulated_files.hpp"

namespace {

void session_drift(benchmark::State& state) {
  const auto scratch = std::filesystem::temp_directory_path() / ("ballbar-bench-" + std::to_string(getpid()));
  const auto folder = scratch / "session";
  const ballbar::SimulatedSession simulated = ballbar::bench::two_arc_session();
  ballbar::write_simulated(ballbar::simulated_files(simulated, false), simulated.truth, folder, scratch / "truth.csv",
                           true);
  for (auto _ : state) {
    benchmark::DoNotOptimize(ballbar::drift_of(ballbar::open_session(folder / "session.toml").session));
  }
  std::filesystem::remove_all(scratch);
}

BENCHMARK(session_drift)->Unit(benchmark::kMillisecond);

}  // namespace
