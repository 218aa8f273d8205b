// A plan in plain words.
#pragma once

#include <string>

#include "ballbar/diagnosis/next_test/test_plan.hpp"

namespace ballbar {

// What to do, what it would show and how surely, what cannot be told.
std::string sentence_of(const TestPlan& plan, const TestPlanOptions& options);

}  // namespace ballbar
