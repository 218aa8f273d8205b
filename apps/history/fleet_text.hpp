// Many machines on one screen: the conclusion, the machines that need something, what to do.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "ballbar/history/fleet.hpp"

namespace ballbar {

// all: every machine that needs something, else the first of them. `remarks`: sentences on what was not read, below the
// conclusion.
std::string fleet_text(const Fleet& fleet, bool all = false, const std::vector<std::string>& remarks = {});

// "2 of 40 machines are beyond a tolerance.", for the text and the page.
std::vector<std::string> fleet_conclusion(const Fleet& fleet);

// Of the table of machines that need something.
std::vector<std::string> fleet_heading();
std::vector<std::string> fleet_row(const FleetMachine& machine);

}  // namespace ballbar
