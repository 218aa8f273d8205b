// Effects that no catalogue has: what the set-up of one of several runs adds (runs.hpp).
#pragma once

#include <memory>

#include "ballbar/effects/effect.hpp"

namespace ballbar {

// Where the zero of a run lies beside that of the first.
const std::shared_ptr<const Effect>& offset_of_run();

// What is left of whatever went before a run that did not begin at rest.
const std::shared_ptr<const Effect>& start_of_run();

}  // namespace ballbar
