// The estimator of instrument software, derived from the values and curves that it stores.
//
//   b = (X' X + L)^-1 X' y
//
// y: measured deviations without the cyclic errors; unweighted, over all readings farther than 1.5 deg from a reversal,
// always with the usual prior L. For two measured files the stored values solve these normal equations within rounding.
// A reversal spike is the largest reading from 0.3 to 9 deg after the reversal, minus the model without cyclic errors.
// This reproduces most stored spikes within 0.5 um; the rule of the software is not known.
#pragma once

#include <vector>

#include "ballbar/machine_errors/machine_errors.hpp"
#include "machine_errors/error_fit.hpp"

namespace ballbar {

// Sets the gains of the spikes in JointErrorFit::as_instrument from the others: the larger one of all recordings, or
// their mean.
void add_spikes_as_instrument(JointErrorFit& fitted, CyclicOfRuns of_runs);

// Sets circularities, shares and ranks, by falling circularity. The circularity of an error is the peak to peak value
// of its curve over all recordings; for a spike or a cyclic error the largest amplitude.
void add_ranks_as_instrument(const JointErrorFit& fitted, const std::vector<MachineError>& rows,
                             std::vector<RankedError>& ranked);

}  // namespace ballbar
