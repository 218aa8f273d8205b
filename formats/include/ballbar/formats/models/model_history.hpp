// The [[history]] of a model `.toml`: the ledger (revision.hpp), with the text that is needed to undo a revision.
//
//   [[history]]
//   revision = 0                             # the model as it started
//   change = "start"
//   target = "z_um"
//   data = ["measured.csv"]                  # as named on the command line
//   parameters = 3                           # free ones
//   rmse_um = 12.3
//   times_floor = 4.0                        # absent if the noise is not known, as held_out_um
//   held_out_um = 14.0
//   verdict = "start"
//   [[history]]
//   revision = 1
//   change = "+ lagged_expansion(T16_degC)"
//   ...                                      # as above
//   likelihood_ratio = 431.0                 # and threshold; each absent if not known
//   still_needed = ["speed_heating(speed_rpm)"]
//   no_longer_needed = []
//   effects_before = '''                     # the earlier text of the effects, unchanged
//   ...'''
//
// The text of the effects reaches from the blank lines above the first [[effect]] and its comments to the [[history]]
// and its comments. The comments of a table are those directly above it. Without effects it is the blank lines at the
// end. Rows are numbered from 0 without gaps. read_model() ignores a history, whatever its content; the functions below
// accept only what they, or ballbar 0.2.0, would write.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/model/model.hpp"
#include "ballbar/revision/revision.hpp"

namespace ballbar {

// The rows of the ledger; empty without a history. Throws Error with name:line:column.
std::vector<LedgerRow> read_ledger(std::string_view bytes, std::string_view name,
                                   const Catalogue& catalogue = built_in_catalogue());

// The text with one more revision. Takes out the `removed` effects (rising indices of the effects in the file) with the
// comments directly above them, appends the `added` ones (with_effect), and adds the row. If there is no history yet,
// `start` becomes revision 0. Sets the number of the row. All other text, comments included, stays. Throws Error as
// read_model() and read_ledger() do, if effects or history are arrays, or if effects are below the history.
std::string with_revision(std::string_view bytes, std::string_view name, std::span<const Term> added,
                          std::span<const std::size_t> removed, const LedgerRow& start, LedgerRow row,
                          const Catalogue& catalogue = built_in_catalogue());

// The text before the last revision: restores the text of the effects and removes the row. Undoing the first revision
// removes the whole history and restores the original bytes. Other comments stay. Throws Error as with_revision() does,
// and if there is no revision to undo.
std::string without_last_revision(std::string_view bytes, std::string_view name,
                                  const Catalogue& catalogue = built_in_catalogue());

}  // namespace ballbar
