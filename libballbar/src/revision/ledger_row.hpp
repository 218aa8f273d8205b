// Figures of a fit as the ledger has them.
#pragma once

#include <cstddef>

#include "ballbar/fit/fit.hpp"
#include "ballbar/model/model.hpp"
#include "ballbar/revision/ledger.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

// fit: of the model to all rows.
LedgerRow row_of(const Fit& fit, const Model& model, const Series& data, std::size_t target);

}  // namespace ballbar
