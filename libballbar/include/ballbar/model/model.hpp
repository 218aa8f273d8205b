// What a user believes: a sum of effects, each bound to columns, and a constant.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/effects/effect.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

// How one parameter enters a fit: held at `start`, or free from there within the bounds.
struct Setting {
  bool held = false;
  double start = 0.0;
  double lower = 0.0;
  double upper = 0.0;
  bool stated = false;  // the user chose the start: no grid is searched

  bool operator==(const Setting& other) const = default;
};

struct Term {
  std::shared_ptr<const Effect> effect;  // of a catalogue, or a user's expression
  std::vector<std::string> columns;      // of the data, as effect->inputs
  std::vector<Setting> settings;         // as effect->parameters

  bool operator==(const Term& other) const = default;
};

// What a column was while the model was fitted.
struct ColumnRange {
  std::string column;
  double low = 0.0, high = 0.0;
};

struct Model {
  Level level = Level::series;
  std::vector<std::string> targets;  // columns to explain, each by its own fit
  std::vector<Term> terms;
  std::optional<double> constant_um;  // held at this value; nothing: free. None on recordings: the circle has it
  std::vector<ColumnRange> trained;   // a column once; none: not known
  // Other columns that no search takes for an input: targets that were put aside.
  std::vector<std::string> not_inputs;
};

// An effect of the catalogue with its own settings. Throws Error for a name that is not in it, with the nearest name.
Term term_of(std::string_view effect_name, std::vector<std::string> columns, Level level = Level::series,
             const Catalogue& catalogue = built_in_catalogue());

// The effect, which must outlive the term, with its own settings.
Term term_of(const Effect& effect, std::vector<std::string> columns);

// "lagged_expansion(T_air_degC)"; "expression(k * T_air_degC)" keeps its formula; "circle 2" is that of the second
// recording. Where no column tells one from another, a shape that the model states does: "step(onset_s = 3600)".
std::string label_of(const Term& term);

// A parameter of a term that is not held, or, on a series, a constant that is not.
bool has_free(const Model& model);

// Throws Error where the model does not suit the data: an unknown column (with the nearest name), a column whose unit
// an input does not take, the same effect on the same columns twice (without columns, with the same label), bounds
// crossed or a start outside them, nothing free, a target that is an input of the model itself.
void expect_suits(const Model& model, const Series& data);

// Throws Error as expect_suits does for targets ("target: expected ..."): none, one twice, one that the data do not
// have, with the nearest.
void expect_explainable(const std::vector<std::string>& targets, const Series& data);

}  // namespace ballbar
