// Parts of a record that are left out, or get their own gain, in turn.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "ballbar/internal/series/folds.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

// Of a trace the column that numbers its recordings; nullptr: a drift series.
const Column* recording_numbers(const Series& data);

// Folds for testing the gains of these columns: `fold`, or quarters of all sweeps if a gain belongs to one recording (a
// vibration has its own phase in each direction), because other recordings cannot predict such a gain.
std::vector<std::size_t> folds_that_tell(const Series& data, const std::vector<std::size_t>& rows,
                                         const std::vector<std::size_t>& fold, const Eigen::MatrixXd& columns);

// The squares of the columns in each fold: one row per fold.
Eigen::MatrixXd squares_by_fold(const Eigen::MatrixXd& columns, const std::vector<std::size_t>& fold);

}  // namespace ballbar
