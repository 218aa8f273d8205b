// Options of a search for missing effects.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/circle/recording.hpp"
#include "ballbar/diagnosis/tuning.hpp"
#include "ballbar/effects/effect.hpp"
#include "ballbar/model/bound_effect.hpp"

namespace ballbar {

// The probability that an effect is missing.
struct ProbableSoFar {
  BoundEffect bound;
  double p = 0.0;
};

struct SearchOptions {
  Catalogue catalogue = built_in_catalogue();  // effects to search; a diagnosis points to them
  std::optional<Motion> motion;                // what moved the ballbar, for recordings
  std::vector<std::string> without;            // names of effects to leave out of the search
  // Of the noise, on a drift. What changes more slowly has a cause, known or not.
  double longest_memory_s = 1200.0;
  Tuning tuning;
  // Called before each step, in the calling thread: "testing 2 effects".
  std::function<void(std::string_view step)> progress;
  // Called with all effects, the most probable first, after each inference; in the calling thread.
  std::function<void(const std::vector<ProbableSoFar>& effects)> so_far;
};

}  // namespace ballbar
