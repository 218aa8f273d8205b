// An input in any form: smoothed, lagged and squared columns of the input, each with its own gain.
//
// The curve of any effect of that input is nearly a sum of these columns, so that they are a rival of every such
// effect.
#pragma once

#include "diagnosis/signatures/signature_library.hpp"

namespace ballbar {

// The "effect" of such a family; not in the catalogue.
const Effect& any_form();

// Appends a family of one signature for each input that an effect of the library reads.
void add_any_forms(SignatureLibrary& library, const Series& data, const std::vector<std::size_t>& rows);

}  // namespace ballbar
