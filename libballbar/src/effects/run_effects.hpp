// Effects outside the catalogue, for several runs (series.hpp).
#pragma once

#include <memory>

#include "ballbar/effects/effect.hpp"

namespace ballbar {

// Of the set-up of one run: the offset of its zero from that of the first run.
const std::shared_ptr<const Effect>& offset_of_run();

// The decaying drift from earlier work in a run that did not begin at rest.
const std::shared_ptr<const Effect>& start_of_run();

// The part of an error that depends on the temperature at the start of a run. For one run it is a constant; with
// several runs a regression needs it (train.hpp).
const std::shared_ptr<const Effect>& temperature_at_start();

}  // namespace ballbar
