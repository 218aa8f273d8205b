// A curve with the phases of its waves drawn anew: as smooth as it was, and without its cause.
#pragma once

#include <complex>
#include <random>
#include <vector>

namespace ballbar {

// Of a curve on an even grid. The line through the ends is taken off first and put back, unless the curve goes round.
struct Spectrum {
  std::vector<std::complex<double>> waves;
  double first = 0.0, rise = 0.0;
};
Spectrum spectrum_of(std::vector<double> values, bool goes_round = false);

// A phase for each wave of a curve of `count` values.
std::vector<double> random_phases(std::size_t count, std::mt19937_64& random);

// Each wave turned by its phase.
std::vector<double> phase_randomised(const Spectrum& spectrum, const std::vector<double>& phases);

}  // namespace ballbar
