// An effect as a user names it on the command line.
//
//   lagged_expansion                                   columns where the data offer one choice
//   lagged_expansion:temperature=T_air_degC            role=column
//   gradient_bending:hot=T3_degC,cold=T16_degC         several roles
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ballbar/model/model.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

struct EffectText {
  const Effect* effect = nullptr;
  std::vector<std::pair<std::string, std::string>> columns;  // role and column; those that are named
};

// Throws Error: an unknown effect or role (with the nearest name), a role twice, columns on recordings.
EffectText effect_text(std::string_view text, Level level, const Catalogue& catalogue = built_in_catalogue());

// The effect with its own settings. Columns that are not named are found where only one choice that is not in
// the model yet goes with those that are. Throws Error: an unknown effect, role or column (with the nearest name), a
// role twice, no column that suits, several choices (listed), columns on recordings, which bind by themselves.
Term term_from_text(std::string_view text, const Model& model, const Series& data,
                    const Catalogue& catalogue = built_in_catalogue());

}  // namespace ballbar
