// Bars that were exchanged or calibrated anew, over all machines that they were used on.
#pragma once

#include <vector>

#include "ballbar/history/history.hpp"
#include "history/quantity_series.hpp"
#include "history/scatter.hpp"

namespace ballbar {

// Where all scales of two machines at least step in common at one date, with one bar that both were tested with, it is
// that bar which was calibrated anew: their findings become FindingKind::instrument.
void note_common_bars(const AllSeries& all, History& history);

// Every exchange of a bar, with the mean step of the scales over the machines, found or not.
std::vector<BarChange> bar_changes_of(const AllSeries& all, const Scatter& scatter);

}  // namespace ballbar
