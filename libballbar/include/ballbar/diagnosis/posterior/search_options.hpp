// What is searched for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/circle/recording.hpp"
#include "ballbar/effects/effect.hpp"
#include "ballbar/model/bound_effect.hpp"

namespace ballbar {

// How probable it is that an effect is missing, by the sets that have been weighed so far.
struct ProbableSoFar {
  BoundEffect bound;
  double p = 0.0;
};

struct SearchOptions {
  Catalogue catalogue = built_in_catalogue();  // searched; a diagnosis refers to its effects
  std::optional<Motion> motion;                // of recordings
  std::vector<std::string> without;            // names of effects that are not searched
  std::uint64_t seed = 1;
  // Told of every step before it begins, by the thread that asked: "testing 200 surrogates of expansion(T_room_degC)".
  std::function<void(std::string_view step)> progress;
  // Told of all effects, the most probable first, whenever more sets have been weighed; by that thread too.
  std::function<void(const std::vector<ProbableSoFar>& effects)> so_far;
};

}  // namespace ballbar
