// An effect as a user names it on the command line: as ballbar prints it, or role by role.
//
//   lagged_expansion                                   the columns, if the data offer only one choice
//   lagged_expansion(T_air_degC)                       as printed: columns in the order of the effect's inputs
//   gradient_bending(T3_degC, T16_degC)
//   viscosity_feedback(T_oil_degC)                     fewer columns: each goes to the next input that takes its unit
//   gradient_bending(cold=T16_degC)                    role=column in brackets
//   gradient_bending:hot=T3_degC,cold=T16_degC         role=column without brackets, needs no quotes in a shell
//   step(onset_s = 3600)                               the start of a shape; or its range, "from 0 to 3600"
//   circle 2                                           the circle of the second recording
//
// A column name may contain anything but quotes, commas, semicolons, brackets and blanks.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ballbar/model/model.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

struct EffectText {
  const Effect* effect = nullptr;
  std::vector<std::pair<std::string, std::string>> columns;    // role and column, as far as the text names them
  std::vector<std::pair<std::size_t, Setting>> settings = {};  // index of a parameter and its setting in the text
};

// Parses the text. `data`, if given, distinguish a column name with an equals sign from role=column. Throws Error: an
// unknown effect or role (with the nearest name), a role twice, more columns than inputs, columns on recordings.
EffectText effect_text(std::string_view text, Level level, const Series* data = nullptr,
                       const Catalogue& catalogue = built_in_catalogue());

// The term that the text names, with the default settings of the effect where the text states none. Columns that the
// text leaves out are chosen from the data if exactly one choice is not in the model yet. Throws Error: an unknown
// effect, role or column (with the nearest name), a role twice, no suitable column, several choices (listed as they can
// be typed), columns on recordings, where effects find their columns by themselves.
Term term_from_text(std::string_view text, const Model& model, const Series& data,
                    const Catalogue& catalogue = built_in_catalogue());

// The effect with each choice of columns that suits it and is not in the model yet. Empty: no column suits, or the
// effect needs a clock and the data have none.
std::vector<BoundEffect> choices_of(const Effect& effect, const Model& model, const Series& data);

}  // namespace ballbar
