// An input whose form is open: smoothed, lagged and squared, each with a gain of its own.
//
// What any effect of that one input adds is nearly a sum of these columns, so that they are the rival of every form.
#pragma once

#include "diagnosis/evidence/logged_inputs.hpp"
#include "diagnosis/signatures/signature_library.hpp"

namespace ballbar {

// The "effect" of such a family; in no catalogue.
const Effect& any_form();

// A family of one signature for each input that some effect of the library reads, put behind the others.
void add_any_forms(SignatureLibrary& library, const Series& data, const std::vector<std::size_t>& rows);

}  // namespace ballbar
