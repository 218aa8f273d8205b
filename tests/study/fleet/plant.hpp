// The sample fleet, test by test: recordings are simulated, the errors fitted as ballbar history does.
#pragma once

#include "ballbar/lab/simulation/virtual_fleet.hpp"
#include "fleet/tally.hpp"

namespace ballbar::study {

Plant plant_of(const VirtualFleet& fleet);

}  // namespace ballbar::study
