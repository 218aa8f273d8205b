// The menu of possible tests, as schedules without expected outcomes.
#pragma once

#include <string>
#include <vector>

#include "ballbar/diagnosis/next_test/plan.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

// Every kind of test with lengths of 4, 8, 12, 24 h below most_hours, and most_hours itself, from short to long.
// Readings are as frequent as in the data, at most 2000. For data without a speed only the room and the coolant change.
std::vector<std::vector<ExpectedTest>> menu_of(const Series& data, const std::string& target,
                                               const TestPlanOptions& options);

}  // namespace ballbar
