// Bars that were exchanged or recalibrated, over all machines on which they were used.
#pragma once

#include <vector>

#include "ballbar/history/history.hpp"
#include "history/quantity_series.hpp"
#include "history/scatter.hpp"

namespace ballbar {

// If all scales of at least two machines step together at one date, and both were tested with the same bar, then that
// bar was recalibrated: their findings become FindingKind::instrument.
void note_common_bars(const AllSeries& all, History& history);

// Every exchange of a bar, with the mean step of the scales over the machines, whether or not it is a finding.
std::vector<BarChange> bar_changes_of(const AllSeries& all, const Scatter& scatter);

}  // namespace ballbar
