// The need of each machine, its reason, and the order of machines.
#pragma once

#include <vector>

#include "ballbar/history/history.hpp"

namespace ballbar {

// Sets need and reason from the findings and tolerances.
void say_need(MachineHistory& machine);

// Order: beyond a tolerance, the farthest first; expected to exceed it, the soonest first; findings, those of the
// machine before season and instrument; nothing. Equal ones by name.
void rank(std::vector<MachineHistory>& machines);

}  // namespace ballbar
