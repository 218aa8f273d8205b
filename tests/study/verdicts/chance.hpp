// Random draws that are the same on every machine: a generator and distributions of the study's own.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace ballbar::verdicts {

class Chance {
 public:
  explicit Chance(std::uint64_t seed) : state_(seed) {}
  Chance(std::string_view stream, std::uint64_t seed);  // another stream for every name

  std::uint64_t bits();
  double uniform();  // [0, 1)
  double between(double low, double high);
  double log_between(double low, double high);
  double normal();
  double student4();  // four degrees of freedom, scaled to variance 1
  std::size_t below(std::size_t count);
  bool happens(double probability);

 private:
  std::uint64_t state_;
};

}  // namespace ballbar::verdicts
