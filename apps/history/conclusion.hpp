// What the history of a machine says first.
#pragma once

#include <string>

#include "ballbar/history/history.hpp"

namespace ballbar {

// What changed, what meets its tolerance first, what has a trend, and how much of that is chance. Lines.
std::string conclusion(const MachineHistory& machine);

}  // namespace ballbar
