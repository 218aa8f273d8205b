// Many machines on one screen: the conclusion, the machines that need attention, and the remedies.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "ballbar/history/history.hpp"

namespace ballbar {

// all: every machine that needs something, else the first of them. `remarks`: sentences on what was not read, below the
// conclusion.
std::string ranking_text(const History& history, bool all = false, const std::vector<std::string>& remarks = {});

// "2 of 40 machines are beyond a tolerance.", for the text and the page.
std::vector<std::string> conclusion(const History& history);
std::string questions_text(const History& history);

// The reason for the rank of a machine, its findings and the remedies.
std::string explanation(const MachineHistory& machine);

// For the table of machines that need attention.
std::vector<std::string> ranking_heading();
std::vector<std::string> ranking_row(const MachineHistory& machine);

}  // namespace ballbar
