// Sessions of measurement in one log.
#pragma once

#include <string>
#include <vector>

#include "ballbar/series/series.hpp"

namespace ballbar {

// The stretches between pauses of more than 20 min, and of more than ten usual steps, behind which the probes were set
// to zero, to a multiple of 100, or to where the log begins: all targets begin there within three times their scatter
// from row to row, or half a resolution, and one was twice as far from it before the pause, before one of less than 8 h
// ten times. A stretch of fewer than 4 rows
// belongs to the one before. Empty: there is no such pause.
std::vector<RowRange> sessions_of(const Series& data, const std::vector<std::string>& targets);

}  // namespace ballbar
