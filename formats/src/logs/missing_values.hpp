// Numbers that loggers write where there is no value.
#pragma once

#include <string>
#include <vector>

namespace ballbar {

// Turns them into gaps where they lie far outside all other values; returns the numbers and how often each was found,
// or nothing.
std::string take_missing_values(std::vector<double>& values);

// Readings of a thermometer that fails: below -60 or above 400 degC, far outside all others, which lie between. An open
// PT100 shows 850, a short circuit -200. degC = factor value + offset. Returns as above.
std::string take_failed_temperatures(std::vector<double>& values, double factor, double offset);

// A number of a temperature that comes back at least three times, at most in a fifth of the readings, beyond all others
// by more than their range and 20 times their usual change, for ten readings at most, after which the temperature is
// near where it was: 0, -1, 85 or 127 of a sensor that does not answer. Not of steps. Returns as above.
std::string take_repeated_numbers(std::vector<double>& values);

// Single readings of a temperature that are far off both neighbours: from the median of 7 by 20 times the usual noise
// of a change (1.4826 median absolute deviation, or the least change) and by half of the 5 to 95 % range, and outside
// this range. Not of steps, not among the three values at either end, not of fewer than 20 values, and not where more
// than 1 % would be taken. Returns as above.
std::string take_single_outliers(std::vector<double>& values);

}  // namespace ballbar
