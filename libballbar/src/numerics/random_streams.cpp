#include "numerics/random_streams.hpp"

#include <cmath>

#include "ballbar/units.hpp"

namespace ballbar::simulation {

std::mt19937_64 stream_of(std::uint64_t seed, Stream kind, std::uint64_t key) {
  const auto low = [](std::uint64_t bits) { return static_cast<std::uint32_t>(bits & 0xffffffffU); };
  std::seed_seq words{low(seed), low(seed >> 32), static_cast<std::uint32_t>(kind), low(key), low(key >> 32)};
  return std::mt19937_64(words);
}

std::uint64_t key_of(double time_s) { return static_cast<std::uint64_t>(std::llround(time_s * 1e6)); }

std::uint64_t key_of(std::string_view name) {
  std::uint64_t hash = 14695981039346656037ULL;
  for (const char letter : name) hash = (hash ^ static_cast<unsigned char>(letter)) * 1099511628211ULL;
  return hash;
}

double uniform(std::mt19937_64& random) { return (static_cast<double>(random() >> 11) + 0.5) * 0x1.0p-53; }

// Box and Muller: sqrt(-2 ln u) cos(2 pi v). std::normal_distribution differs between standard libraries.
double normal(std::mt19937_64& random) {
  const double u = uniform(random);
  const double v = uniform(random);
  return std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * kPi * v);
}

// e_0 = sigma w_0,  e_i = phi e_(i-1) + sqrt(1 - phi^2) sigma w_i
double Ar1::next(std::mt19937_64& random) { return next(sigma_ * normal(random)); }

double Ar1::next(double white) {
  last_ = started_ ? phi_ * last_ + std::sqrt(1.0 - phi_ * phi_) * white : white;
  started_ = true;
  return last_;
}

double rounded(double value, double resolution) {
  if (resolution == 0.0) return value;
  const double steps = std::round(value / resolution);
  const double per_unit = std::round(1.0 / resolution);
  const bool decimal = per_unit >= 1.0 && std::abs(per_unit * resolution - 1.0) < 1e-12;
  return decimal ? steps / per_unit : steps * resolution;
}

}  // namespace ballbar::simulation
