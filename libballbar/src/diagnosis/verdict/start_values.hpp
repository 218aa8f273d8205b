// Start values for terms that are added to a model.
#pragma once

#include <cstddef>
#include <vector>

#include "ballbar/model/model.hpp"
#include "diagnosis/posterior/inference.hpp"

namespace ballbar {

std::vector<BoundEffect> bounds_of(const std::vector<Term>& terms);

// The set of all these effects, valid until the next request; nullptr: the model absorbs one of them.
const EffectSet* set_of_all(Inference& found, const std::vector<BoundEffect>& bounds);

// The index of the term in the set, which must contain it.
std::size_t member_of(const Inference& found, const EffectSet& set, const BoundEffect& bound);

// The terms with their shapes at the most likely joint values, except stated starts. The identities of `found` must
// include these terms.
std::vector<Term> with_start_values(Inference& found, std::vector<Term> terms);

// The model with these terms at their start values.
Model model_with(Inference& found, Model model, std::vector<Term> terms);

Model model_without(Model model, std::size_t term);

}  // namespace ballbar
