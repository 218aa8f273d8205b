// A test of which a `.b5r` keeps the instrument's results alone, and the limits that one states: in the names and units
// of MachineErrors.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "ballbar/formats/recordings/b5r.hpp"
#include "ballbar/history/machine_test.hpp"

namespace ballbar {

// Its stored values, without sigma; no quantities where it stores none of these.
MachineTest stored_test(const B5r& b5r);

// Of its limits those that hold for a quantity of the machine; where one warns and one fails, the one that fails.
std::vector<Tolerance> stated_tolerances(const B5r& b5r);

}  // namespace ballbar
