// From the gains of a fit to the table: rows, circularity, shares and ranks.
#pragma once

#include <Eigen/Core>
#include <set>
#include <vector>

#include "ballbar/machine_errors/machine_errors.hpp"
#include "machine_errors/error_fit.hpp"

namespace ballbar {

struct ErrorTable {
  std::vector<MachineError> rows;
  Eigen::MatrixXd covariance;  // of the rows' values
};

// A row a gain; of sine and cosine, which may be each recording's own, one amplitude. The sigma of an amplitude is
// widened where its 95 % interval reaches 0: an amplitude is never negative, and in noise alone it is not 0.
ErrorTable error_table(const ErrorFitted& fitted, CyclicOfRuns cyclic_of_runs);

// Falling IC, without ranks: these are by the gain (error_gains.hpp).
std::vector<RankedError> ranked_errors(const ErrorFitted& fitted, const ErrorTable& table);

// RMS of the rows of one direction, the errors of these effects taken from the readings of the other (all else as
// fitted), both ways; one direction alone: NaN.
double held_out_rms_um(const ErrorFitted& fitted, const std::set<const Effect*>& effects);

// RMS that the circles leave, fitted anew beside the errors of these effects.
double rms_with_um(const ErrorFitted& fitted, const std::set<const Effect*>& effects);

}  // namespace ballbar
