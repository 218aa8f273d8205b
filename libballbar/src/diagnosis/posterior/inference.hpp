// A model, data, and the posterior over sets of effects: what every command that judges an effect starts from.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "ballbar/model/bound_effect.hpp"
#include "diagnosis/posterior/posterior.hpp"

namespace ballbar {

struct Inference {
  std::unique_ptr<Problem> problem;
  Posterior posterior;      // empty where nothing can be said
  std::size_t largest = 0;  // effects of a set, by the number of values
  bool is_still = false;    // the readings do not move
};

// Once more with every value about a jump that is found; and where clocks prove late, or readings lie far from the
// others, without what that spoils. Throws Error as fit does.
Inference inference(const Model& model, const Series& data, std::size_t target, const ProblemOptions& options);

// The family of the library; nothing: it has none.
std::optional<std::size_t> family_of(const Problem& problem, const BoundEffect& bound);

}  // namespace ballbar
