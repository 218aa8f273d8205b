#include "chance.hpp"

#include <cmath>
#include <numbers>

namespace ballbar::verdicts {

// FNV-1a of the name.
Chance::Chance(std::string_view stream, std::uint64_t seed) : state_(1469598103934665603ULL) {
  for (const char letter : stream) state_ = (state_ ^ static_cast<unsigned char>(letter)) * 1099511628211ULL;
  state_ += seed * 0xd1342543de82ef95ULL;
  bits();
}

// splitmix64
std::uint64_t Chance::bits() {
  state_ += 0x9e3779b97f4a7c15ULL;
  std::uint64_t z = state_;
  z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27U)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31U);
}

double Chance::uniform() { return static_cast<double>(bits() >> 11U) * 0x1.0p-53; }

double Chance::between(double low, double high) { return low + (high - low) * uniform(); }

double Chance::log_between(double low, double high) { return low * std::pow(high / low, uniform()); }

double Chance::normal() {
  const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
  return radius * std::cos(2.0 * std::numbers::pi * uniform());
}

double Chance::student4() {
  const double numerator = normal();
  double squares = 0.0;
  for (int k = 0; k < 4; ++k) {
    const double one = normal();
    squares += one * one;
  }
  return numerator / std::sqrt(squares / 4.0) / std::numbers::sqrt2;
}

std::size_t Chance::below(std::size_t count) { return static_cast<std::size_t>(bits() % count); }

bool Chance::happens(double probability) { return uniform() < probability; }

}  // namespace ballbar::verdicts
