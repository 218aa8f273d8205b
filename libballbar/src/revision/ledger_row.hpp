// Figures of a fit as the ledger has them.
#pragma once

#include "ballbar/revision/ledger.hpp"
#include "diagnosis/statistics/ml_noise_fit.hpp"

namespace ballbar {

// fit: to all rows; seen: to as many as are tested.
LedgerRow row_of(const Fit& fit, const NoiseFit& seen);

}  // namespace ballbar
