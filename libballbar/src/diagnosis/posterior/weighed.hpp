// A model, data, and the posterior over sets of effects: what every command that judges an effect starts from.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "ballbar/diagnosis/posterior/probable_so_far.hpp"
#include "ballbar/model/bound_effect.hpp"
#include "diagnosis/posterior/posterior.hpp"

namespace ballbar {

struct Weighed {
  std::unique_ptr<Problem> problem;
  Posterior posterior;      // empty where nothing can be weighed
  std::size_t largest = 0;  // effects of a set, by the number of values
  bool is_still = false;    // the readings do not move: there is nothing to weigh
};

// Who is told how far the weighing is; each may be empty.
struct Told {
  std::function<void(std::string_view step)> step;
  std::function<void(const std::vector<ProbableSoFar>&)> so_far;
};

// Once more with every value about a jump that is found; and where clocks prove late, or readings lie far from the
// others, without what that spoils. Throws Error as fit does.
Weighed weighed(const Model& model, const Series& data, std::size_t target, const ProblemOptions& options,
                const Told& told = {});

// The family of the library; nothing: it has none.
std::optional<std::size_t> family_of(const Problem& problem, const BoundEffect& bound);

}  // namespace ballbar
