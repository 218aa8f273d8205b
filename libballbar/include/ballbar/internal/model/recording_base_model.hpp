// The base model of recordings: circles without any effect.
//
// Each recording has its own centre, because the position of the bar is set-up. Each has its own radius too if all have
// the same feed. If the feeds differ by more than 5 % and the bars have one length, all recordings share one radius.
// Separate radii would absorb the influence of the feed on the radius (`dynamic_contraction`).
#pragma once

#include "ballbar/model/model.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

// The base model of a trace from trace_of(); its target is deviation_um. The terms are of the catalogue's base effect
// on recordings. Its shared gains (EffectRules::one_for_all) are the radius, the others the centre. Throws Error where
// the catalogue has no base effect.
Model recording_base_model(const Series& trace, const Catalogue& catalogue = built_in_catalogue());

// The model with the circles of the trace before its own terms. A model that has a circle is returned unchanged.
Model with_circles(Model model, const Series& trace);

// Throws Error for an effect of the model that does not act with this motion.
void expect_acts(const Model& model, Motion motion);

}  // namespace ballbar
