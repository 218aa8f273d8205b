// The history for other programs.
#pragma once

#include <string>
#include <vector>

#include "ballbar/history/history.hpp"
#include "history/test_files.hpp"

namespace ballbar {

// One row a test and quantity: file, date, plane, length_mm, feed_mm_per_min, arc_deg, quantity, value, sigma, unit.
// Empty: not known.
std::string history_csv(const std::vector<MachineTest>& tests);

}  // namespace ballbar
