// The test of an effect (effect_test.hpp) for the terminal and for a program.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "ballbar/revision/effect_test.hpp"
#include "ballbar/revision/ledger.hpp"

namespace ballbar {

// "The data support X.", or why they do not.
std::string conclusion(const EffectTest& effect_test);

// Error before and after, added effects with their likelihood ratios and surrogates, earlier effects tested anew, all
// parameters.
std::string tables(const EffectTest& effect_test);

nlohmann::ordered_json json_of(const EffectTest& effect_test);
nlohmann::ordered_json json_of(const LedgerRow& row, const LedgerRow* before);

}  // namespace ballbar
