// A model: a sum of effects, each bound to columns, and a constant.
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
  bool stated = false;  // the user stated the start: the grid is not searched

  bool operator==(const Setting& other) const = default;
};

struct Term {
  std::shared_ptr<const Effect> effect;  // of a catalogue, or a user's expression
  std::vector<std::string> columns;      // of the data, in the order of effect->inputs
  std::vector<Setting> settings;         // in the order of effect->parameters

  bool operator==(const Term& other) const = default;
};

// The range of a column in the data that the model was fitted to.
struct ColumnRange {
  std::string column;
  double low = 0.0, high = 0.0;
};

struct Model {
  Level level = Level::series;
  std::vector<std::string> targets;  // columns to explain, each with its own fit
  std::vector<Term> terms;
  std::optional<double> constant_um;  // held at this value; nullopt: free. Unused on recordings, which have circles
  std::vector<ColumnRange> trained;   // each column once; empty: not known
  // Columns that a search does not use as inputs: targets that were put aside.
  std::vector<std::string> not_inputs;
};

// A term with the default settings of an effect. Throws Error, with the nearest name, for an effect that is not in the
// catalogue.
Term term_of(std::string_view effect_name, std::vector<std::string> columns, Level level = Level::series,
             const Catalogue& catalogue = built_in_catalogue());

// The same for an effect that must outlive the term.
Term term_of(const Effect& effect, std::vector<std::string> columns);

// The printed name of a term: "lagged_expansion(T_air_degC)"; "expression(k * T_air_degC)" with its formula; "circle 2"
// for the second recording. A term without columns shows a stated shape: "step(onset_s = 3600)".
std::string label_of(const Term& term);

// Whether the model has a free parameter, or on a series a free constant.
bool has_free(const Model& model);

// Throws Error where the model does not suit the data: an unknown column (with the nearest name), a column in a unit
// that the input does not accept, the same effect twice on the same columns (or twice with the same label), a lower
// bound above the upper, a start outside its bounds, no free parameter, a target that is an input of the model.
void expect_suits(const Model& model, const Series& data);

// Throws Error as expect_suits() does for targets ("target: expected ..."): no target, a target twice, or a target that
// the data do not have (with the nearest name).
void expect_explainable(const std::vector<std::string>& targets, const Series& data);

}  // namespace ballbar
