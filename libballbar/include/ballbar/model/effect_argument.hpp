// An effect as a user names it on the command line: as ballbar prints it, or role by role.
//
//   lagged_expansion                                   columns where the data offer one choice
//   lagged_expansion(T_air_degC)                       as printed: columns in the order of the effect's inputs
//   gradient_bending(T3_degC, T16_degC)
//   viscosity_feedback(T_oil_degC)                     one left out: each goes to the next input that takes its unit
//   gradient_bending(cold=T16_degC)                    role=column, also in brackets
//   gradient_bending:hot=T3_degC,cold=T16_degC         role=column without brackets, which no shell needs quoted
//   step(onset_s = 3600)                               a start that the label tells; or its range, "from 0 to 3600"
//   circle 2                                           of the second recording
//
// The name of a column is anything but quotes, commas, semicolons, brackets and blanks.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ballbar/model/bound_effect.hpp"
#include "ballbar/model/model.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

struct EffectText {
  const Effect* effect = nullptr;
  std::vector<std::pair<std::string, std::string>> columns;    // role and column; those that are named
  std::vector<std::pair<std::size_t, Setting>> settings = {};  // number of a parameter, and what the text says of it
};

// `data`, where they are known, tell a column whose name has an equals sign from role=column. Throws Error: an unknown
// effect or role (with the nearest name), a role twice, more columns than inputs, columns on recordings.
EffectText effect_text(std::string_view text, Level level, const Series* data = nullptr,
                       const Catalogue& catalogue = built_in_catalogue());

// The effect with its own settings, but for those that the text states. Columns that are not named are found where only
// one choice that is not in the model yet goes with those that are. Throws Error: an unknown effect, role or column
// (with the nearest name), a role twice, no column that suits, several choices (listed as they can be typed), columns
// on recordings, which bind by themselves.
Term term_from_text(std::string_view text, const Model& model, const Series& data,
                    const Catalogue& catalogue = built_in_catalogue());

// An effect with each choice of columns that suits it and is not in the model yet; none: no column suits, or data
// without a clock cannot show it.
std::vector<BoundEffect> choices_of(const Effect& effect, const Model& model, const Series& data);

}  // namespace ballbar
