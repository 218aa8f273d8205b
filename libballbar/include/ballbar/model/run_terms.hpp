// What a model has beside its effects where the data are several runs.
//
// A zero of its own for each run but the first, whose zero is the model's constant; for each run that begins warm what
// is left of that, an exponential. Gains and shapes of all effects are shared, their memory begins anew (runs.hpp).
// These terms are of the data: a model that is written has none of them.
#pragma once

#include "ballbar/model/model.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

// The model with these terms before its own; of one run, or of recordings, as it is.
Model with_run_terms(Model model, const Series& data);

// Without them.
Model without_run_terms(Model model);

}  // namespace ballbar
