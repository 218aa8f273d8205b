#pragma once

#include <string_view>

#include "ballbar/diagnosis/verdict/diagnosis.hpp"
#include "ballbar/model/effect_argument.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

// An effect with the columns that were not named: the trace's own on recordings; else the only one whose unit the input
// takes and that is not `target`. Throws Error where there is none or a choice, with the choices.
BoundEffect resolve_columns(const EffectText& text, const Series& data, std::string_view target);

}  // namespace ballbar
