// Terms that are added to a model: where a fit of the model with them begins.
#pragma once

#include <cstddef>
#include <vector>

#include "ballbar/model/bound_effect.hpp"
#include "ballbar/model/model.hpp"
#include "diagnosis/posterior/inference.hpp"

namespace ballbar {

std::vector<BoundEffect> bounds_of(const std::vector<Term>& terms);

// The set of all of these effects; nothing: one of them adds nothing of its own. Until another one is asked for.
const EffectSet* set_of_all(Inference& found, const std::vector<BoundEffect>& bounds);

// Its place in the set, which has it.
std::size_t member_of(const Inference& found, const EffectSet& set, const BoundEffect& bound);

// Their shapes begin where they are likeliest together, but where a start is stated. `found` has these terms among what
// may be missing.
std::vector<Term> begun(Inference& found, std::vector<Term> terms);

// The model with these terms, begun.
Model model_with(Inference& found, Model model, std::vector<Term> terms);

}  // namespace ballbar
