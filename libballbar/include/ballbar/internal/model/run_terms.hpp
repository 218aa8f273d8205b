// Extra terms of a model when the data are several runs.
//
// Each run after the first has its own zero; the zero of the first is the constant of the model. Each run that begins
// warm has a decaying exponential for the earlier heat. All runs share the gains and shapes of the effects; the memory
// of the effects restarts with each run (series.hpp). The extra terms belong to the data and are not written to model
// files.
#pragma once

#include "ballbar/model/model.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

// The model with these terms before its own. Unchanged for one run and for recordings.
Model with_run_terms(Model model, const Series& data);

// The model without these terms.
Model without_run_terms(Model model);

}  // namespace ballbar
