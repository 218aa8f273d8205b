// The steps of an effect test, for who keeps some of what they need.
#pragma once

#include <cstddef>
#include <vector>

#include "ballbar/revision/effect_test.hpp"
#include "diagnosis/posterior/inference.hpp"

namespace ballbar {

// A model fitted to all rows, with the figures of its row.
struct FittedModel {
  Model model;
  Fit fit;
  LedgerRow row;
};

// Whether a search of these data tries the term as it is.
bool is_usual(const Term& term, const Model& model, const Series& data);

// Their shapes begin where they are likeliest together, but where a start is stated. `found` has these terms among what
// may be missing.
std::vector<Term> begun(Inference& found, std::vector<Term> terms);

// count: the last terms of `after`, which were added. `found`: what may be missing from `before`, these terms among it.
EffectTest effect_test_of(Inference& found, FittedModel before, FittedModel after, std::size_t count,
                          const Series& data, std::size_t target);

}  // namespace ballbar
