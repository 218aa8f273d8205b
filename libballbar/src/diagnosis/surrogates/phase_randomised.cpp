#include "diagnosis/surrogates/phase_randomised.hpp"

#include <unsupported/Eigen/FFT>

#include "ballbar/units.hpp"
#include "numerics/random_streams.hpp"

namespace ballbar {

Spectrum spectrum_of(std::vector<double> values, bool goes_round) {
  Spectrum spectrum;
  if (!goes_round) {
    spectrum.first = values.front();
    spectrum.rise = values.back() - values.front();
  }
  const auto n = static_cast<double>(values.size() - 1);
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] -= spectrum.first + spectrum.rise * static_cast<double>(i) / n;
  }
  thread_local Eigen::FFT<double> fft;
  fft.fwd(spectrum.waves, values);
  return spectrum;
}

std::vector<double> random_phases(std::size_t count, std::mt19937_64& random) {
  std::vector<double> phases((count + 1) / 2);  // of the waves 0 to below count / 2; that of 0 is not used
  for (double& phase : phases) phase = 2.0 * kPi * simulation::uniform(random);
  return phases;
}

std::vector<double> phase_randomised(const Spectrum& spectrum, const std::vector<double>& phases) {
  std::vector<std::complex<double>> waves = spectrum.waves;
  const std::size_t n = waves.size();
  for (std::size_t k = 1; 2 * k < n; ++k) {
    waves[k] *= std::polar(1.0, phases[k]);
    waves[n - k] = std::conj(waves[k]);
  }
  thread_local Eigen::FFT<double> fft;
  std::vector<double> values;
  fft.inv(values, waves);
  for (std::size_t i = 0; i < n; ++i) {
    values[i] += spectrum.first + spectrum.rise * static_cast<double>(i) / static_cast<double>(n - 1);
  }
  return values;
}

}  // namespace ballbar
