// What a blind data set is drawn from.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "ballbar/challenge/blind.hpp"
#include "ballbar/challenge/inject.hpp"
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

// A shop floor with a spindle: what went on, and what of it is logged.
struct Workshop {
  Series sensors;  // true, every sensor
  Series causes;   // true positions by cause
  Series logged;   // measured, some of the sensors
};

enum class Plan { usual, one_speed, constant_room };

// one_speed: a rest, then one speed and load to the end. Logged are always the speed, in one_speed the load, and
// T_room_degC and T_front_degC; in constant_room T_room_degC is constant.
Workshop workshop_of(Plan kind, Random& random);

// Usual shapes of the effect on these rows (Parameter::usual_on), gains 1 or -1.
Injection drawn_injection(const BoundEffect& bound, const Series& logged, Random& random);

struct Hidden {
  std::string what;
  std::optional<BoundEffect> bound;     // of the catalogue
  std::vector<BoundEffect> match = {};  // spindle
  std::vector<double> signal_um;        // before it is scaled to its d
  std::vector<double> parameters = {};  // of the bound effect
};

// An effect of the catalogue that the logged columns drive and the model lacks; nothing where the draw does not suit.
std::optional<Hidden> drawn_effect(const Catalogue& catalogue, const Model& model, const Series& logged,
                                   Random& random);

// Beyond the catalogue. Evaluated on the true sensors.
Hidden drawn_outsider(const Series& sensors, Random& random);

// Causes of the spindle that may be hidden in that target, in drawn order.
std::vector<Hidden> drawn_causes(const Catalogue& catalogue, const Workshop& workshop, std::string_view target,
                                 Random& random);

}  // namespace ballbar::blind
