// Random numbers of the virtual machine: independent streams, the same with every standard library.
#pragma once

#include <cstdint>
#include <random>
#include <string_view>

namespace ballbar::simulation {

enum class Stream : std::uint32_t {
  c_arc = 1,
  a_arc,
  rotation,
  axial,
  ccw,
  cw,
  signal,
  probe,
  spindle_noise,
  spindle_memory,
  spindle_variety,
  blind_kind,
  blind_set,
  fleet_machine = 15,  // with 14 the machines of a fleet would be others
  fleet_test,
  fleet_bar
};

// The stream of that seed, kind and key; the key is the test's time or the column's name.
std::mt19937_64 stream_of(std::uint64_t seed, Stream kind, std::uint64_t key);
std::uint64_t key_of(double time_s);          // to the microsecond
std::uint64_t key_of(std::string_view name);  // FNV-1a

double uniform(std::mt19937_64& random);  // in (0, 1), 53 bits
double normal(std::mt19937_64& random);   // mean 0, standard deviation 1

// AR(1) noise with stationary standard deviation `sigma` and autocorrelation `phi` of neighbours.
class Ar1 {
 public:
  Ar1(double sigma, double phi) : sigma_(sigma), phi_(phi) {}
  double next(std::mt19937_64& random);
  // From a number of any distribution with mean 0 and standard deviation `sigma`.
  double next(double white);

 private:
  double sigma_;
  double phi_;
  double last_ = 0.0;
  bool started_ = false;
};

// Nearest multiple of `resolution`, as the double nearest to its decimal where 1 / resolution is whole;
// 0: the value itself.
double rounded(double value, double resolution);

}  // namespace ballbar::simulation
