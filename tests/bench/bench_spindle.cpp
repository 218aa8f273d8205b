// 46 h of the finite-volume spindle, in steps of 15 s.
#include <benchmark/benchmark.h>

#include "ballbar/lab/spindle/finite_volume_spindle.hpp"

namespace {

void spindle_46h(benchmark::State& state) {
  constexpr double kHour_s = 3600.0;
  ballbar::DutyPlan plan;
  for (int step = 0; step < 12; ++step) {
    plan.time_s.push_back(4.0 * step * kHour_s);
    plan.speed_rpm.push_back(step % 2 == 0 ? 0.0 : 1250.0 * (step + 1));
  }
  plan.end_s = 46.0 * kHour_s;
  for (auto _ : state) benchmark::DoNotOptimize(ballbar::run_of({}, plan));
}
BENCHMARK(spindle_46h)->Unit(benchmark::kMillisecond);

}  // namespace
