// The test of an effect (revision.hpp) for the terminal.
#pragma once

#include <string>

#include "ballbar/message.hpp"
#include "ballbar/revision/revision.hpp"

namespace ballbar {

// "The data support X.", or the reasons against it.
Paragraph conclusion(const EffectTest& effect_test);

// "gain_um_per_K of expansion(T1_degC)"; empty: the test frees nothing.
std::string freed_text(const EffectTest& effect_test);

// Error before and after, added effects with 2 ln B. details: earlier effects tested anew, all
// parameters, and what the figures mean.
std::string tables(const EffectTest& effect_test, bool details);

}  // namespace ballbar
