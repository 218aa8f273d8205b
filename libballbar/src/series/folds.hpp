// Stretches of a record that are left out, or given a gain of their own, one after the other.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "ballbar/series/folds.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

// Of a trace the column that numbers its recordings; nullptr: a drift series.
const Column* recording_numbers(const Series& data);

// Folds by which the gains of these columns can be tested: `fold`, but where a gain belongs to one recording (a
// vibration has a phase of its own in each direction) that recording cannot be told from the others, and quarters of
// all sweeps are left out.
std::vector<std::size_t> folds_that_tell(const Series& data, const std::vector<std::size_t>& rows,
                                         const std::vector<std::size_t>& fold, const Eigen::MatrixXd& columns);

}  // namespace ballbar
