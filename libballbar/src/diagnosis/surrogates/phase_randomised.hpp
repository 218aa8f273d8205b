// A curve with random phases: the same spectrum, without the cause.
#pragma once

#include <complex>
#include <random>
#include <vector>

namespace ballbar {

// For a curve on an even grid. Unless the curve is periodic, the line through its ends is subtracted first and added
// again.
struct Spectrum {
  std::vector<std::complex<double>> waves;
  double first = 0.0, rise = 0.0;
};
Spectrum spectrum_of(std::vector<double> values, bool goes_round = false);

// A random phase for each wave of a curve of `count` values.
std::vector<double> random_phases(std::size_t count, std::mt19937_64& random);

// The curve with each wave shifted by its phase.
std::vector<double> phase_randomised(const Spectrum& spectrum, const std::vector<double>& phases);

}  // namespace ballbar
