// The tests that a shop can do, as schedules, with nothing expected of them yet.
#pragma once

#include <string>
#include <vector>

#include "ballbar/diagnosis/next_test/test_plan.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

// Kinds by lengths of 4, 8, 12, 24 h up to most_hours, and that; a reading as often as the data have one, at most 2000.
// Of a machine whose data have no speed, only what stands beside it: the room, the coolant.
std::vector<ExpectedTest> menu_of(const Series& data, const std::string& target, const TestPlanOptions& options);

}  // namespace ballbar
