// Effects and their settings as a model file writes them.
#pragma once

#include <string>

#include "ballbar/model/model.hpp"

namespace ballbar {

// The value of a parameter's key; empty: the key may be left out. own: of a formula.
std::string setting_text(const Setting& setting, const Parameter& parameter, bool own);

// The table of an effect, from its header on.
std::string effect_text(const Term& term);

}  // namespace ballbar
