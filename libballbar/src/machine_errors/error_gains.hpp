// The benefit of correcting each error: the circularity minus that without its curve, and the ranks by it.
//
// Sigma by block bootstrap: the residual is resampled in blocks of 10 deg of one recording, with replacement. The gains
// of the fit and both circularities are recomputed, 40 times with fixed seeds.
#pragma once

#include "ballbar/machine_errors/machine_errors.hpp"
#include "machine_errors/error_fit.hpp"

namespace ballbar {

// Sets circularities, gains, ranks and order of the ranked errors in `found`. An error has a rank if it is significant
// and its correction lowers the circularity by at least 0.05 um, half of the last printed digit.
void add_gains(MachineErrors& found, const JointErrorFit& fitted, bool with_sigmas);

}  // namespace ballbar
