// Numbers that loggers write where there is no value.
#pragma once

#include <string>
#include <vector>

namespace ballbar {

// Turns them into gaps where they lie far outside all other values; returns the numbers and how often each was found,
// or nothing.
std::string take_missing_values(std::vector<double>& values);

}  // namespace ballbar
