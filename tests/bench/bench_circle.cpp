// The fit of a long circle beside the least a fit could do: the sine and cosine of every angle once.
// Readings: BALLBAR_BENCH_READINGS, 10^6 unless given.
#include <benchmark/benchmark.h>

#include <chrono>
#include <cmath>
#include <cstdlib>

#include "ballbar/circle/circle.hpp"
#include "bench_data.hpp"
#include "heap_peak.hpp"

namespace {

using Clock = std::chrono::steady_clock;

const ballbar::Recording& circle() {
  static const char* const readings = std::getenv("BALLBAR_BENCH_READINGS");
  static const ballbar::Recording recording =
      ballbar::bench::circle_of(readings ? std::strtoull(readings, nullptr, 10) : 1'000'000);
  return recording;
}

double sine_pass(const ballbar::Recording& recording) {
  double sum_mm = 0.0;
  for (std::size_t i = 0; i < recording.angle_rad.size(); ++i) {
    sum_mm += recording.length_mm[i] * (std::cos(recording.angle_rad[i]) + std::sin(recording.angle_rad[i]));
  }
  return sum_mm;
}

void circle_sine_pass(benchmark::State& state) {
  const ballbar::Recording& recording = circle();
  for (auto _ : state) benchmark::DoNotOptimize(sine_pass(recording));
}

void fit_of(benchmark::State& state, const ballbar::CircleOptions& options) {
  const ballbar::Recording& recording = circle();
  const double readings = static_cast<double>(recording.length_mm.size());
  std::chrono::duration<double> fit_s{0.0};
  std::chrono::duration<double> pass_s{0.0};
  std::size_t peak = 0;
  for (auto _ : state) {
    const std::size_t before = ballbar::bench::heap_in_use();
    ballbar::bench::restart_heap_peak();
    const Clock::time_point start = Clock::now();
    benchmark::DoNotOptimize(ballbar::fit_circle(recording, options));
    fit_s += Clock::now() - start;
    peak = ballbar::bench::heap_peak() - before;
    state.PauseTiming();
    const Clock::time_point pass_start = Clock::now();
    benchmark::DoNotOptimize(sine_pass(recording));
    pass_s += Clock::now() - pass_start;
    state.ResumeTiming();
  }
  state.counters["times_sine_pass"] = fit_s / pass_s;
  state.counters["peak_bytes_a_reading"] = static_cast<double>(peak) / readings;
  state.counters["readings"] = readings;
}

void circle_fit(benchmark::State& state) { fit_of(state, {}); }
void circle_fit_polar(benchmark::State& state) { fit_of(state, {.model = ballbar::CircleModel::polar}); }
void circle_fit_robust(benchmark::State& state) { fit_of(state, {.robust = true}); }

BENCHMARK(circle_sine_pass)->Unit(benchmark::kMillisecond);
BENCHMARK(circle_fit)->Unit(benchmark::kMillisecond);
BENCHMARK(circle_fit_polar)->Unit(benchmark::kMillisecond);
BENCHMARK(circle_fit_robust)->Unit(benchmark::kMillisecond);

}  // namespace
