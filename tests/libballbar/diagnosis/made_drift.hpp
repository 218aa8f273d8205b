// A drift with an effect of the catalogue hidden in it, and one with nothing.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>

#include "../made_series.hpp"
#include "ballbar/diagnosis/verdict/diagnose.hpp"

namespace ballbar::made {

inline constexpr std::size_t kRows = 400;

// First-order lag over one row of 100 s, its input a straight line: what the speed does between two rows is not known.
inline double lagged(double value, double from, double to, double tau_s) {
  constexpr int kSteps = 200;
  for (int k = 0; k < kSteps; ++k) {
    const double input = from + (to - from) * (k + 0.5) / kSteps;
    value += (input - value) * (1.0 - std::exp(-100.0 / kSteps / tau_s));
  }
  return value;
}

struct Drift {
  double room_um_per_K = 0.0;  // of the room behind 1500 s
  std::uint64_t seed = 1;
  std::size_t rows = kRows;
  double noise_um = 0.3;
  double exponent = 5.0 / 3.0;  // of the speed's heat
};

// Speeds of 1.5 h, a room that swings and steps, a bearing that warms with the speed; noise AR(1) 0.8.
inline Series drift(const Drift& how) {
  std::mt19937_64 random(how.seed);
  std::normal_distribution<double> normal;
  Series data;
  Column speed{"speed_rpm", Role::speed, {}}, room{"T_room_degC", Role::ambient, {}},
      bearing{"T_bearing_degC", Role::bearing, {}}, target{"z_um", Role::measured, {}};
  const double speeds[] = {0, 4000, 8000, 0, 6000, 2000, 8000, 0};
  double heat = 0.0, warm = 0.0, slow = 0.0, noise = 0.0, n_before = 0.0, room_before = 0.0;
  for (std::size_t i = 0; i < how.rows; ++i) {
    const double t = static_cast<double>(i) * 100.0;
    const double n = speeds[static_cast<std::size_t>(t / 5400.0) % 8];
    const double room_now =
        22.0 + 0.8 * std::sin(t / 3100.0) + 0.5 * std::sin(t / 1300.0 + 1.0) + (t > 21000.0 ? 1.5 : 0.0);
    if (i == 0) slow = room_before = room_now;
    heat = lagged(heat, std::pow(n_before / 1000.0, how.exponent), std::pow(n / 1000.0, how.exponent), 2300.0);
    warm = lagged(warm, n_before / 1000.0, n / 1000.0, 900.0);
    slow = lagged(slow, room_before, room_now, 1500.0);
    n_before = n;
    room_before = room_now;
    noise = 0.8 * noise + 0.6 * how.noise_um * normal(random);
    data.time_s.push_back(t);
    speed.values.push_back(n);
    room.values.push_back(room_now + 0.02 * normal(random));
    bearing.values.push_back(23.0 + 1.4 * warm + 0.02 * normal(random));
    target.values.push_back(0.4 * heat + how.room_um_per_K * (slow - 22.0) + noise);
  }
  data.columns = {speed, room, bearing, target};
  return data;
}

inline Model by_speed() {
  Model model;
  model.targets = {"z_um"};
  model.terms = {term_of("speed_heating", {"speed_rpm"})};
  return model;
}

inline std::vector<std::string> labels_of(const std::vector<BoundEffect>& bounds) {
  std::vector<std::string> labels;
  for (const BoundEffect& bound : bounds) labels.push_back(label_of(bound));
  std::sort(labels.begin(), labels.end());
  return labels;
}

}  // namespace ballbar::made
