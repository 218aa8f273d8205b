// Effects outside the catalogue that describe the set-up of one of several runs (runs.hpp).
#pragma once

#include <memory>

#include "ballbar/effects/effect.hpp"

namespace ballbar {

// The offset of the zero of a run from that of the first run.
const std::shared_ptr<const Effect>& offset_of_run();

// The decaying drift from earlier work in a run that did not begin at rest.
const std::shared_ptr<const Effect>& start_of_run();

}  // namespace ballbar
