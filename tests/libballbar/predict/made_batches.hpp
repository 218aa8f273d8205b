// Batches of thermal tests made of a fast and a slow rise over the room's temperature, as sensors log them.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "../made_series.hpp"
#include "ballbar/predict/train.hpp"

namespace ballbar::made {

// FNV-1a, the same everywhere: seeds keyed by a test's name.
inline std::uint64_t seed_of(std::string_view name) {
  std::uint64_t hash = 14695981039346656037u;
  for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211u;
  return hash;
}

struct Batches {
  std::size_t sensors = 24;  // the last is the room's
  std::size_t rows = 120;    // one every 30 s
  double noise_K = 0.05;     // before rounding to 0.1 K
  double noise_um = 0.5;
};

// A warm-up by `heat_K` (hottest sensor, after all): T_j = room + a_j fast + b_j slow, z = gain fast + 0.3 slow + 0.1
// room.
inline Series warm_up(const Batches& plan, double room_degC, double heat_K, double gain_um_per_K,
                      std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  Series series;
  std::vector<double> z_um;
  for (std::size_t j = 0; j + 1 < plan.sensors; ++j) series.columns.push_back({fmt::format("T{:02}_degC", j + 1)});
  series.columns.push_back({"T_room_degC"});
  for (std::size_t i = 0; i < plan.rows; ++i) {
    const double time_s = 30.0 * static_cast<double>(i);
    const double room = room_degC + 0.5 * std::sin(time_s / 1500.0 + room_degC);
    const double fast = heat_K * (1.0 - std::exp(-time_s / 600.0));
    const double slow = heat_K * (1.0 - std::exp(-time_s / 2400.0));
    series.time_s.push_back(time_s);
    for (std::size_t j = 0; j < plan.sensors; ++j) {
      const bool is_room = j + 1 == plan.sensors;
      const double a = is_room ? 0.0 : 0.1 + 0.9 * static_cast<double>(j * 7 % 23) / 22.0;
      const double b = is_room ? 0.0 : 0.3 * static_cast<double>(j * 5 % 23) / 22.0;
      const double degC = room + a * fast + b * slow + plan.noise_K * normal(random);
      series.columns[j].values.push_back(std::round(10.0 * degC) / 10.0);
    }
    z_um.push_back(gain_um_per_K * fast + 0.3 * slow + 0.1 * room + plan.noise_um * normal(random));
  }
  series.columns.push_back({"z_um", Role::measured, std::move(z_um)});
  return series;
}

// Rooms of 10 to 30 degC and heats of 15 to 35 K, drawn.
inline std::vector<Series> warm_ups(std::size_t count, const Batches& plan, std::string_view seed) {
  std::mt19937_64 random(seed_of(seed));
  std::uniform_real_distribution<double> uniform;
  std::vector<Series> all;
  for (std::size_t k = 0; k < count; ++k) {
    const double room = 10.0 + 20.0 * uniform(random), heat = 15.0 + 20.0 * uniform(random);
    all.push_back(warm_up(plan, room, heat, 0.8, random));
  }
  return all;
}

inline BatchColumns columns_of(const std::vector<Series>& all, InputKind kind = InputKind::temperature) {
  return batch_columns(all.front(), kind, "z_um", {});
}

inline std::vector<Batch> batches_of(const std::vector<Series>& all, const BatchColumns& columns) {
  std::vector<Batch> batches;
  for (std::size_t k = 0; k < all.size(); ++k) {
    batches.push_back(batch_of(fmt::format("batch {}", k + 1), all[k], columns));
  }
  return batches;
}

}  // namespace ballbar::made
