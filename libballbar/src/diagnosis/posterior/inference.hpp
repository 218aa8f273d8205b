// A model, data, and the posterior over sets of effects: the basis of every command that judges an effect.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "ballbar/model/model.hpp"
#include "diagnosis/posterior/posterior.hpp"

namespace ballbar {

struct Inference {
  std::unique_ptr<Problem> problem;
  Posterior posterior;      // empty: no statement possible
  std::size_t largest = 0;  // largest number of effects in a set, from the number of values
  bool is_still = false;    // the readings are constant
};

// Of a long series every k-th value is used, and every value near a jump that the search finds. On recordings the
// inference is repeated with outliers that count less. Throws Error as fit() does.
Inference inference(const Model& model, const Series& data, std::size_t target, const ProblemOptions& options);

// The family of the library; nullopt: none.
std::optional<std::size_t> family_of(const Problem& problem, const BoundEffect& bound);

}  // namespace ballbar
