#pragma once

#include <string_view>

#include "ballbar/diagnosis/verdict/diagnosis.hpp"
#include "ballbar/model/effect_argument.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

// Completes the columns of an effect: on recordings those of the trace; else the only column in a unit of the input
// that is not `target`. Throws Error if there is none, or several, with the choices.
BoundEffect resolve_columns(const EffectText& text, const Series& data, std::string_view target);

}  // namespace ballbar
