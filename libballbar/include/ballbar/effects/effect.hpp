// One physical effect: what it adds to a measured series, and what a user should know about it.
//
// An effect is one constant value in one file of src/effects; effects() is the one list of them. The same kind
// serves a drift series (inputs: speed, temperatures ...) and a ballbar recording turned into a series (inputs:
// angle, direction, feed ...; see trace.hpp). A model is a sum of effects and a constant (model.hpp).
//
// Values are in um, one a row of the data, evaluated over the whole series at once, so that an effect with memory
// is one recursion, O(n). A `gain` enters linearly and starts at 0, where the effect is off; a `shape` (time
// constant, exponent, threshold) does not, and carries the grid over which starts are searched.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/circle/recording.hpp"

namespace ballbar {

enum class Level { series, recording };
enum class ParameterKind { gain, shape };

struct Parameter {
  std::string name;  // ends in its unit: "gain_um_per_K", "time_constant_s"
  std::string unit;  // as printed: "um/K", "s"; "1" for none
  ParameterKind kind = ParameterKind::gain;
  double start = 0.0;
  double lower = 0.0;  // bounds; may be infinite
  double upper = 0.0;
  std::vector<double> grid;  // shape: starts to try, rising; empty: start alone
  std::string meaning;
  bool held = false;  // a model that does not name it keeps it at `start`
};

// A column that the effect reads. `role` is its key in a model file: temperature = "T_air_degC".
struct Input {
  std::string role;
  std::vector<std::string> units;  // accepted, as columns end: {"degC", "K"}
  std::string meaning;
};

// The page that `ballbar effects NAME` prints; whole sentences.
struct Explanation {
  std::string summary;  // one line
  std::string cause;
  std::string formula;                     // as evaluated, in the letters of the parameters
  std::string signature;                   // how it looks in a residual
  std::vector<std::string> confused_with;  // names of effects
  std::string becomes = {};                // effect of its inputs, or of some, that it is at the edge of its shapes
  std::string separated_by;                // the test that tells them apart
  std::string remedy;                      // in the workshop
  std::string validity;
  std::string source;
};

// The rows an effect is evaluated on: n times and, in the order of Effect::inputs, n values of each input.
struct EffectRows {
  std::span<const double> time_s;  // rising
  std::vector<std::span<const double>> inputs;
};

// values: n. derivatives: n times the number of parameters, row by row; nullptr: not wanted.
using EvaluateAll =
    std::function<void(const EffectRows& rows, const double* parameters, double* values, double* derivatives)>;

// The value at row i, for signals that arrive live: from rows 0, i - 1 and i alone and from `kept`, the numbers that an
// effect with memory hands on, which it sets at row 0. Row by row it gives what EvaluateAll gives, to the last bit.
using EvaluateRow =
    std::function<double(const EffectRows& rows, std::size_t i, const double* parameters, double* kept)>;

struct Evaluate {
  EvaluateAll all;
  EvaluateRow row = {};  // empty: needs more than these rows
  std::size_t kept = 0;  // how many numbers

  void operator()(const EffectRows& rows, const double* parameters, double* values, double* derivatives) const {
    all(rows, parameters, values, derivatives);
  }
};

struct Effect {
  std::string name;
  Level level = Level::series;
  Explanation explanation;
  std::vector<Input> inputs;
  std::vector<Parameter> parameters;
  Evaluate evaluate;
  bool time_only = false;            // needs no input but time: never named as a cause from one run
  std::vector<Motion> motions = {};  // recordings it applies to, by what drives the circle; empty: any
};

// Whether it acts in recordings that `motion` drives.
bool applies_to(const Effect& effect, Motion motion);

// All of the catalogue, drift series first, in the order of the documentation.
std::span<const Effect* const> effects();

// The effect of that name, or nullptr. `level` decides where both have one (bar_temperature).
const Effect* find_effect(std::string_view name, Level level);

}  // namespace ballbar
