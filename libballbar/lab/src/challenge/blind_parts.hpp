// What a blind data set is drawn from.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/internal/diagnosis/injection/injection.hpp"
#include "ballbar/lab/challenge/blind.hpp"
#include "ballbar/lab/simulation/virtual_spindle.hpp"
#include "numerics/random_streams.hpp"

namespace ballbar::blind {

using Random = std::mt19937_64;

inline double between(Random& random, double low, double high) {
  return low + (high - low) * simulation::uniform(random);
}
inline double log_between(Random& random, double low, double high) {
  return low * std::pow(high / low, simulation::uniform(random));
}
inline bool chance(Random& random, double p) { return simulation::uniform(random) < p; }
inline std::size_t index_below(Random& random, std::size_t count) {
  return std::min(count - 1, static_cast<std::size_t>(simulation::uniform(random) * static_cast<double>(count)));
}
template <class Values>
auto one_of(Random& random, const Values& values) {
  return values[index_below(random, values.size())];
}

enum class Plan { usual, one_speed, constant_room };

// A shop floor with a spindle: what went on, and what of it is logged.
struct Workshop {
  Series sensors;  // true, every sensor
  Series causes;   // true positions by cause
  Series logged;   // measured, some of the sensors
};

// one_speed: a rest, then one speed and load to the end. Logged are always the speed, in one_speed the load, and
// T_room_degC and T_front_degC; in constant_room T_room_degC is constant.
Workshop workshop_of(Plan kind, Random& random);

// Noise of the target: AR(1), rounded last.
struct Scatter {
  double sigma_um = 0.2, phi = 0.9, resolution_um = 0.01;  // phi: from row to row
  bool heavy = false;
};
Scatter drawn_scatter(Random& random);
Noise noise_model(const Scatter& scatter, double interval_s);
std::vector<double> noise_um(std::size_t n, const Scatter& scatter, Random& random);

// Usual shapes of the effect on these rows (Parameter::usual_on), gains 1 or -1.
Injection drawn_injection(const BoundEffect& bound, const Series& logged, Random& random);

struct HiddenEffect {
  std::string what;
  std::optional<BoundEffect> bound;     // of the catalogue
  std::vector<BoundEffect> match = {};  // spindle
  std::vector<double> signal_um;        // before it is scaled to its d
};

// An effect of the catalogue that the logged columns drive and the model lacks; nothing where the draw does not suit.
std::optional<HiddenEffect> drawn_effect(const Model& model, const Series& logged, Random& random);

// Beyond the catalogue. Evaluated on the true sensors.
HiddenEffect drawn_outsider(const Series& sensors, Random& random);

// Causes of the spindle that may be hidden in that target, in drawn order.
std::vector<HiddenEffect> drawn_causes(const Workshop& workshop, std::string_view target, Random& random);

}  // namespace ballbar::blind
