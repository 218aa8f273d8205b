// The [[history]] of a model `.toml`: the ledger (ledger.hpp), and what takes a revision back.
//
//   [[history]]
//   revision = 0                             # the model as it started
//   change = "start"
//   target = "z_um"
//   data = ["measured.csv"]                  # as named on the command line
//   parameters = 3                           # free ones
//   rmse_um = 12.3
//   times_floor = 4.0                        # absent where the floor is not known; so held_out_um
//   held_out_um = 14.0
//   verdict = "start"
//   [[history]]
//   revision = 1
//   change = "+ lagged_expansion(T16_degC)"
//   ...                                      # as above
//   likelihood_ratio = 431.0                 # and threshold, best_surrogate_fall; each absent where not known
//   still_needed = ["speed_heating(speed_rpm)"]
//   no_longer_needed = []
//   effects_before = '''                     # the text of the effects as they were, to the letter
//   ...'''
//
// The text of the effects is all from the blank lines above the first [[effect]] and its comments to the [[history]]
// and its comments, where comments of a table are those directly above it; without effects, the blank lines at the
// end. Rows count from 0 without a gap. read_model() passes
// a history over, whatever it says; these functions take only what they would write.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/model/model.hpp"
#include "ballbar/revision/ledger.hpp"

namespace ballbar {

// Rows of the ledger of a model with effects of the catalogue; none where there is no history. Throws Error with
// name:line:column.
std::vector<LedgerRow> read_ledger(std::string_view bytes, std::string_view name,
                                   const Catalogue& catalogue = built_in_catalogue());

// The text with one more revision: `removed` effects (numbers of the file's own, rising) taken out with the comments
// directly above them, `added` ones after the others (with_effect), and its row. Where there is no history yet,
// `start` goes before it as revision 0. The row's number is given here. Comments and all else stay as they are. Throws
// Error as read_model and read_ledger, where effects or history are arrays, or where effects stand below the history.
std::string with_revision(std::string_view bytes, std::string_view name, std::span<const Term> added,
                          std::span<const std::size_t> removed, const LedgerRow& start, LedgerRow row,
                          const Catalogue& catalogue = built_in_catalogue());

// The text before the last revision: effects to the letter as they were, its row gone; with the first revision all of
// the history, so that the bytes are those before it. Comments elsewhere stay. Throws Error as with_revision, and where
// there is nothing to take back.
std::string without_last_revision(std::string_view bytes, std::string_view name,
                                  const Catalogue& catalogue = built_in_catalogue());

}  // namespace ballbar
