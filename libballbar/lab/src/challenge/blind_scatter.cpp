#include <array>

#include "challenge/blind_parts.hpp"

namespace ballbar::blind {
namespace {

// Student's t with 4 degrees of freedom over its standard deviation, sqrt 2; or normal.
double innovation(const Scatter& scatter, Random& random) {
  const double w = simulation::normal(random);
  if (!scatter.heavy) return w;
  double squares = 0.0;
  for (int i = 0; i < 4; ++i) {
    const double each = simulation::normal(random);
    squares += each * each;
  }
  return w / std::sqrt(squares / 4.0) / std::sqrt(2.0);
}

}  // namespace

Scatter drawn_scatter(Random& random) {
  Scatter scatter;
  scatter.sigma_um = log_between(random, 0.1, 0.5);
  scatter.phi = between(random, 0.5, 0.98);
  scatter.resolution_um = one_of(random, std::array{0.01, 0.02, 0.05, 0.1});
  scatter.heavy = chance(random, 0.25);
  return scatter;
}

// Rounding is a white noise with a standard deviation of resolution / sqrt 12.
Noise noise_model(const Scatter& scatter, double interval_s) {
  return {scatter.resolution_um / std::sqrt(12.0), scatter.sigma_um, -interval_s / std::log(scatter.phi), 0.0};
}

std::vector<double> noise_um(std::size_t n, const Scatter& scatter, Random& random) {
  std::vector<double> values;
  simulation::Ar1 memory(1.0, scatter.phi);
  double last = memory.next(random);
  for (std::size_t i = 0; i < n; ++i) {
    values.push_back(scatter.sigma_um * last);
    last = memory.next(innovation(scatter, random));
  }
  return values;
}

}  // namespace ballbar::blind
