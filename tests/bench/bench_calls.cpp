// A fit of 360 readings as a program in C++ calls it: beside it python_bench.py calls the same from Python.
#include <benchmark/benchmark.h>

#include <cmath>

#include "ballbar/formats/text/source.hpp"
#include "ballbar/units.hpp"
#include "measure/recording_fits.hpp"

namespace {

ballbar::Recording circle() {
  ballbar::Recording recording;
  for (int degree = 0; degree < 360; ++degree) {
    recording.angle_rad.push_back(ballbar::rad_from_deg(degree));
    recording.length_mm.push_back(100.0 + 0.005 * std::cos(recording.angle_rad.back()));
  }
  return recording;
}

void fit_of_360(benchmark::State& state) {
  const std::vector<ballbar::Source> sources{{"<data>", std::vector<ballbar::Recording>{circle()}}};
  for (auto _ : state) benchmark::DoNotOptimize(ballbar::fit_files(sources, {}));
}
BENCHMARK(fit_of_360)->Unit(benchmark::kMicrosecond);

}  // namespace
