// All errors of a machine from one ballbar test, CCW and CW of 1500 readings each: fitted, with sigma and ranks.
#include <benchmark/benchmark.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <vector>

#include "ballbar/formats/recordings/recording_file.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "ballbar/machine_errors/machine_errors.hpp"
#include "bench_data.hpp"

namespace {

const std::vector<ballbar::Recording>& runs() {
  static const std::vector<ballbar::Recording> recordings =
      ballbar::read_b5r(ballbar::bench::b5r_bytes(), "memory").runs;
  return recordings;
}

void machine_errors(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(ballbar::machine_errors(runs()));
}

// Pitches that a file states are not searched.
void machine_errors_known_pitch(benchmark::State& state) {
  std::vector<ballbar::Recording> recordings = runs();
  for (ballbar::Recording& recording : recordings) recording.pitch_a_mm = recording.pitch_b_mm = 10.0;
  for (auto _ : state) benchmark::DoNotOptimize(ballbar::machine_errors(recordings));
}

// Four tests at one place together.
void machine_errors_of_4_tests(benchmark::State& state) {
  std::vector<ballbar::Recording> recordings;
  for (int k = 0; k < 4; ++k) recordings.insert(recordings.end(), runs().begin(), runs().end());
  for (auto _ : state) benchmark::DoNotOptimize(ballbar::machine_errors(recordings));
}

void machine_errors_file(benchmark::State& state) {
  const auto path = std::filesystem::temp_directory_path() / ("ballbar-bench-" + std::to_string(getpid()) + ".b5r");
  ballbar::write_bytes(path, ballbar::bench::b5r_bytes());
  for (auto _ : state) {
    const ballbar::RecordingFile file = ballbar::open_recording(path);
    benchmark::DoNotOptimize(ballbar::machine_errors(file.recordings));
  }
  std::filesystem::remove(path);
}

BENCHMARK(machine_errors)->Unit(benchmark::kMillisecond);
BENCHMARK(machine_errors_known_pitch)->Unit(benchmark::kMillisecond);
BENCHMARK(machine_errors_of_4_tests)->Unit(benchmark::kMillisecond);
BENCHMARK(machine_errors_file)->Unit(benchmark::kMillisecond);

}  // namespace
