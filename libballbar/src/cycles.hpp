// Stretches of a record that are left out, or given a gain of their own, one after the other.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "ballbar/series.hpp"

namespace ballbar {

// Of a trace the column that numbers its recordings; nullptr: a drift series.
const Column* recording_numbers(const Series& data);

// Cycle of every row: stretches between changes of speed, short ones joined to their neighbour, those of more than a
// fifth of the rows cut into equal pieces; without a speed five parts of the time. Of a trace each recording is one; a
// single recording is left out by quarters of its sweep.
std::vector<std::size_t> cycles_of(const Series& data, const std::vector<std::size_t>& rows);

// Cycles by which the gains of these columns can be tested: as `cycle`, but where a gain belongs to one recording (a
// vibration has a phase of its own in each direction) that recording cannot be told from the others, and quarters of
// all sweeps are left out.
std::vector<std::size_t> cycles_that_tell(const Series& data, const std::vector<std::size_t>& rows,
                                          const std::vector<std::size_t>& cycle, const Eigen::MatrixXd& columns);

}  // namespace ballbar
