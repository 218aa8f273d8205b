// EFFECT of a command line: a name, with columns where there is a choice: "lagged_expansion:temperature=T_air_degC".
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ballbar/diagnosis.hpp"
#include "ballbar/effect.hpp"
#include "ballbar/series.hpp"

namespace ballbar {

struct EffectOption {
  const Effect* effect = nullptr;
  std::vector<std::pair<std::string, std::string>> columns;  // role, column; those that are stated
};

// NAME or NAME:ROLE=COLUMN,ROLE=COLUMN. Throws Error: a name or a role that is not known (with the nearest), one twice.
EffectOption effect_option(std::string_view text, Level level);

// With the columns that were not stated: the trace's own on recordings; else the only one whose unit the input takes
// and that is not `target`. Throws Error where there is none or a choice, with the choices.
BoundEffect bound_to(const EffectOption& option, const Series& data, std::string_view target);

}  // namespace ballbar
