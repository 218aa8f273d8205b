// Makes the table from the gains of a fit: rows, circularity, shares and ranks.
#pragma once

#include <Eigen/Core>
#include <set>
#include <vector>

#include "ballbar/machine_errors/machine_errors.hpp"
#include "machine_errors/error_fit.hpp"

namespace ballbar {

struct ErrorTable {
  std::vector<MachineError> rows;
  Eigen::MatrixXd covariance;     // of the rows' values
  std::vector<double> extent_um;  // of the curve of one sigma of each, peak to peak; 0 of an amplitude
};

// One row per gain; sine and cosine, possibly of each recording, give one amplitude. The sigma of an amplitude is
// widened if its 95 % interval reaches 0, because an amplitude is never negative, and not 0 in pure noise.
ErrorTable error_table(const JointErrorFit& fitted, CyclicOfRuns cyclic_of_runs);

// The groups of the fit, in its order; without ranks and gains, which error_gains.hpp sets.
std::vector<ErrorGroup> error_groups(const JointErrorFit& fitted);

// Sorted by falling IC, without ranks, which error_gains.hpp sets.
std::vector<RankedError> ranked_errors(const JointErrorFit& fitted, const ErrorTable& table);

// RMS of the rows of each direction with the errors of these effects from the readings of the other direction (all else
// as fitted), both ways; NaN for one direction.
double held_out_rms_um(const JointErrorFit& fitted, const std::set<const Effect*>& effects);

// RMS of the residual of the circles and the errors of these effects, fitted again.
double rms_with_um(const JointErrorFit& fitted, const std::set<const Effect*>& effects);

}  // namespace ballbar
