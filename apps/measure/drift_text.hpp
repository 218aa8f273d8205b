// Sentences about a drift series.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ballbar/drift/drift.hpp"
#include "ballbar/drift/thermal_test.hpp"
#include "ballbar/formats/results/drift_results.hpp"
#include "ballbar/message.hpp"

namespace ballbar {

bool any_has(const DriftSeries& series, std::optional<Estimate> DriftPoint::*member);

std::string time_text(double time_s);  // "64 min"

// "y 30.1 ± 0.0 um at 64 min"
std::vector<std::string> largest_texts(const std::vector<LargestDrift>& largest);

// "Largest drift: y 30.1 ± 0.0 um at 64 min."
Message largest_sentence(const LargestDrift& largest);

// "OD: a trend of 2.20 ± 0.05 um/h (99 %), a step of -9.5 ± 0.4 um at 4 h 27 min; noise 0.9 um"
std::vector<std::string> course_texts(const std::vector<Course>& courses);

// Which thermal test it is with its speeds, the temperatures, and what the record lacks: a sentence each.
std::vector<std::string> thermal_test_texts(const ThermalTest& test);

// When each axis is stable: a line each.
std::vector<std::string> settling_texts(const std::vector<AxisSettling>& settling);

}  // namespace ballbar
