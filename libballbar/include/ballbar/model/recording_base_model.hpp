// What a trace is without any effect.
//
// A centre for each recording: where a bar stands is set-up. A radius for each recording too, as long as they are all
// driven at one feed; at feeds that differ by more than 5 %, of bars of one length, one radius for all, because what
// the feed does to the radius (`dynamic_contraction`) would else be taken for set-up, one radius a recording.
#pragma once

#include "ballbar/model/model.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

// Of trace_of(); target deviation_um. The terms are those of the catalogue's base effect on recordings: its gains that
// are one for all (EffectRules::one_for_all) are the radius, the others the centre. Throws Error where it has none.
Model recording_base_model(const Series& trace, const Catalogue& catalogue = built_in_catalogue());

// The model with the circles of the trace before its own terms; as it is where it has a circle of its own.
Model with_circles(Model model, const Series& trace);

// Throws Error for an effect that does not act where this drives the circle.
void expect_acts(const Model& model, Motion motion);

}  // namespace ballbar
