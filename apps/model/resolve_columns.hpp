#pragma once

#include <string>
#include <string_view>

#include "ballbar/diagnosis/verdict/diagnose.hpp"
#include "ballbar/internal/model/effect_argument.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

// Completes the columns of an effect: on recordings those of the trace; else the only column in a unit of the input
// that is not `target`. Throws Error if there is none, or several, with the choices.
BoundEffect resolve_columns(const EffectText& text, const Series& data, std::string_view target);

// An effect as a user types it, with the columns as the data name them: "expansion(T room (C)).gain_um_per_K=2" becomes
// "expansion(T_room_degC).gain_um_per_K=2". What is no column stays. Throws Error for a name that several may have.
std::string with_column_names(const std::string& effect, const Series& data);

}  // namespace ballbar
