// Sessions of measurement in one log.
#pragma once

#include <string>
#include <vector>

#include "ballbar/series/series.hpp"

namespace ballbar {

// The stretches between pauses of more than 8 h, and of more than ten usual steps, behind which the probes were set to
// the value with which the log begins, mostly 0: all targets begin there within five times their scatter from row to
// row, and one was farther from it before the pause. Empty: there is no such pause, or a stretch has fewer than 12
// rows.
std::vector<RowRange> sessions_of(const Series& data, const std::vector<std::string>& targets);

}  // namespace ballbar
