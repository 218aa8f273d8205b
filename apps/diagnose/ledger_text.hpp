// A row of the ledger of a model, in words.
#pragma once

#include "ballbar/message.hpp"
#include "ballbar/revision/revision.hpp"

namespace ballbar {

// "Revision 2 added lagged_expansion(T16_degC). RMSE 12.3 -> 3.1 um (4.0 -> 1.0 times the noise), left-out cycles
// 14.0 -> 3.9 um. 2 ln B is 431.2 (threshold 10.0). speed_heating(speed_rpm) is still needed." Without figures from
// before where `before` is nullptr or of another target or other data; of recordings "left-out recordings".
Paragraph sentence_of(const LedgerRow& row, const LedgerRow* before);

}  // namespace ballbar
