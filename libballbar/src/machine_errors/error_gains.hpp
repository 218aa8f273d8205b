// What mending each error gains: the circularity now less that without its curve, and the ranks by it.
//
// Sigma by resampling: what is left of the readings, in blocks of 10 deg of one recording drawn with replacement, is
// put in place of itself; the gains of the fit follow it, and both circularities. 40 times, always with the same draws.
#pragma once

#include "ballbar/machine_errors/machine_errors.hpp"
#include "machine_errors/error_fit.hpp"

namespace ballbar {

// Fills circularities and gains of `found`, whose ranked errors are there, and ranks and orders these. A rank has what
// is significant and lowers the circularity by at least 0.05 um, half of the digit that is printed.
void add_gains(MachineErrors& found, const ErrorFitted& fitted, bool with_sigmas);

}  // namespace ballbar
