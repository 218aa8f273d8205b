// Sentences about a drift series.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ballbar/drift/drift.hpp"
#include "ballbar/drift/settling.hpp"

namespace ballbar {

bool any_has(const DriftSeries& series, std::optional<Estimate> DriftPoint::*member);

// "y 30.1 ± 0.0 um at 64 min": the largest drift of each quantity in the series.
std::vector<std::string> largest_drifts(const DriftSeries& series);

// When each axis is stable: a line each.
std::vector<std::string> settling_texts(const std::vector<AxisSettling>& settling);

}  // namespace ballbar
