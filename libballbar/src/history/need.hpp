// What a machine needs, why, and in which order.
#pragma once

#include <vector>

#include "ballbar/history/history.hpp"

namespace ballbar {

// From its findings and tolerances: need and reason.
void say_need(MachineHistory& machine);

// Beyond a tolerance first, the farthest first; then those that will be, the soonest first; then clear findings, those
// of the machine before those of the season and the instrument; then nothing. By name where they are equal.
void rank(std::vector<MachineHistory>& machines);

}  // namespace ballbar
