// What instrument software would say of a test: its estimator, worked out from values and curves that it stores.
//
//   b = (X' X + L)^-1 X' y
//
// y: deviations as they are read, freed of the cyclic errors; unweighted, over all readings farther than 1.5 deg from a
// reversal, with the usual prior L always. On two measured files the normal equations with the stored values leave
// nothing but rounding. A reversal spike is its largest reading from 0.3 to 9 deg after the reversal, less the model
// without cyclic errors: by this most stored ones are met within 0.5 um, for the software's own rule is not known.
#pragma once

#include <vector>

#include "ballbar/machine_errors/machine_errors.hpp"
#include "machine_errors/error_fit.hpp"

namespace ballbar {

// The gains of the spikes among ErrorFitted::as_instrument, from the others there: of recordings the larger, or their
// mean.
void add_spikes_as_instrument(ErrorFitted& fitted, CyclicOfRuns of_runs);

// Circularities, shares and ranks by falling circularity. Of an error: peak to peak of its curve over all recordings;
// of a spike or a cyclic error the largest amplitude.
void add_ranks_as_instrument(const ErrorFitted& fitted, const std::vector<MachineError>& rows,
                             std::vector<RankedError>& ranked);

}  // namespace ballbar
