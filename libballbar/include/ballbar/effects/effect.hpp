// One physical effect: what it adds to a measured series, and what a user should know about it.
//
// An effect is one constant value in one file of src/effects, and all that is known of it stands there: fits, searches
// and tests ask the value, none knows an effect or a parameter by its name. The same kind serves a drift series
// (inputs: speed, temperatures ...) and a ballbar recording turned into a series (inputs: angle, direction, feed ...;
// see trace.hpp). A model is a sum of effects and a constant (model.hpp). A catalogue is a list of effects: the
// built-in one, or a user's own, which may add to it.
//
// Values are in um, one a row of the data, evaluated over the whole series at once, so that an effect with memory
// is one recursion, O(n). A `gain` enters linearly and starts at 0, where the effect is off; a `shape` (time
// constant, exponent, threshold) does not, and carries the grid over which starts are searched.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/circle/recording.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

enum class Level { series, recording };
enum class ParameterKind { gain, shape };

// The rows an effect is evaluated on: n times and, in the order of Effect::inputs, n values of each input.
struct EffectRows {
  std::span<const double> time_s;  // rising; of several runs (runs.hpp) in each
  std::vector<std::span<const double>> inputs;
  std::size_t run = 0;         // number of the run that these rows are of
  std::vector<double> zero{};  // of several runs: each input in the first row of the first; else none
};

// What an input is counted from where something happens at a place of it: its first value, of several runs that of the
// first, because the place is one of the machine.
inline double zero_of(const EffectRows& rows, std::size_t input) {
  return rows.zero.empty() ? rows.inputs[input][0] : rows.zero[input];
}

// What a shape says.
enum class ShapeOf {
  curve,      // a time constant, an exponent, a width ...
  onset,      // a moment in the time of the data, s: searched from row to row, and no better known than their distance
  period,     // of what repeats, s
  recording,  // the number of the recording that a term belongs to, 0, 1 ...; -1: all. Held; a term's label tells it
};

// Whether it is a number of the physics: not a moment, nor what the term belongs to.
inline bool is_of_curve(ShapeOf shape_of) { return shape_of == ShapeOf::curve || shape_of == ShapeOf::period; }

// Starts to try on given rows, in the parameter's unit, within [lower, upper] and at most `most`. Of what repeats,
// every half of what the length of the rows can resolve: a sinusoid is found only from a start that near.
using GridOnRows =
    std::function<std::vector<double>(const EffectRows& rows, double lower, double upper, std::size_t most)>;

// A usual value on given rows, in the parameter's unit; share 0 to 1: the least to the largest of them.
using UsualOnRows = std::function<double(const EffectRows& rows, double share)>;

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
  ShapeOf shape_of = ShapeOf::curve;
  GridOnRows grid_on = {};    // in place of `grid`, where starts depend on the rows
  UsualOnRows usual_on = {};  // shape: for blind challenges; empty: evenly in the logarithm from the grid's second
                              // value to its last but one
  std::string row = {};       // gain of an error of the machine: the row of the table it makes, "pos" of "NAME_pos";
                              // two of one row are sine and cosine of an amplitude
};

// Starts to try on these rows: of `grid_on` or of `grid`, those from `lower` to `upper`. Empty: the parameter's start
// alone.
std::vector<double> grid_of(const Parameter& parameter, const EffectRows& rows, double lower, double upper,
                            std::size_t most);

// A column that the effect reads. `role` is its key in a model file: temperature = "T_air_degC". Where a user names no
// column, and in a search, the role takes every column in one of the units but the target and sigmas that is accepted;
// on recordings the trace's own.
struct Input {
  std::string role;
  std::vector<std::string> units;  // accepted, as columns end: {"degC", "K"}
  std::string meaning;
  // Empty: any column; in um those of an axial drift alone (z_um, axial_um, the Z of five probes).
  std::function<bool(const Column& column)> accepts = {};
  bool of_another_effect = false;  // accepts only columns that an effect of the model reads
  std::string none_accepted = {};  // a phrase where units suit, and no column is accepted: "no column of the bar"
};

// The page that `ballbar effects NAME` prints; whole sentences.
struct Explanation {
  std::string summary;  // one line
  std::string cause;
  std::string formula;                     // as evaluated, in the letters of the parameters
  std::string signature;                   // how it looks in a residual
  std::vector<std::string> confused_with;  // names of effects
  std::string separated_by;                // the test that tells them apart
  std::string remedy;                      // in the workshop
  std::string validity;
  std::string source;
};

// values: n. derivatives: n times the number of parameters, row by row; nullptr: not wanted.
using EvaluateAll =
    std::function<void(const EffectRows& rows, const double* parameters, double* values, double* derivatives)>;

// The values of the rows i from `begin` to before `end`, for signals that arrive live: each from rows 0, i - 1 and i
// alone and from `kept`, the numbers that an effect with memory hands on, which it sets at row 0. In pieces of any
// length it gives what EvaluateAll gives, to the last bit. May be called by several threads, each with numbers of its
// own.
using EvaluateRows = std::function<void(const EffectRows& rows, std::size_t begin, std::size_t end,
                                        const double* parameters, double* kept, double* values)>;

// Writes what a unit of each gain adds at this shape, gain after gain, n values each.
using UnitCurvesAt = std::function<void(double shape, double* curves)>;

// For a search over many shapes of one run's rows: what does not depend on the shape is worked out once. To rounding it
// gives the derivatives of EvaluateAll by the gains.
using UnitCurvesOn = std::function<UnitCurvesAt(const EffectRows& rows)>;

struct Evaluate {
  EvaluateAll all;
  EvaluateRows rows = {};         // empty: needs more than these rows
  std::size_t kept = 0;           // how many numbers
  std::size_t parameters = 0;     // how many; several runs need it
  UnitCurvesOn unit_curves = {};  // of an effect with one shape; empty: by the derivatives

  // On the rows of several runs each begins anew.
  void operator()(const EffectRows& rows, const double* at, double* values, double* derivatives) const;
};

// What moves the finite-volume spindle of blind challenges (blind.hpp).
enum class SpindleCause { centrifugal, rings, housing, structure, bending };

// A cause that the effect explains rightly: on the sensors of the parts that make it, or on any columns.
struct ExplainedCause {
  SpindleCause cause = SpindleCause::centrifugal;
  bool on_its_sensors = false;
};

// What an error says of the two axes of its plane beside each other.
enum class AxisRelation {
  none,
  scale,  // how much longer A is over a diameter, um
  angle,  // from +A to +B less a right angle, um/m
};

// Where an error of the machine is fitted (machine_errors.hpp).
enum class ErrorFit {
  none,              // it is none
  together,          // with all others of this kind, on all readings but those at a reversal
  where_it_shows,    // with them where it is clear, on full turns alone
  at_reversals,      // on what they leave within 9 deg of its own reversals; a shape is its width
  along_the_travel,  // on what they leave, between the reversals; a shape is its wave length; each recording its own
};

// Where instrument software gives an error of the machine a rank.
enum class RankedByInstrument { always, on_full_turns, never };

// Of an error of the machine: a sum of its gains that is held near 0 where the readings say little
// of it, as if so many readings more, all of them where it shows most, had found nothing of it. Worked out from what
// instrument software stores.
struct Damping {
  enum class Where {
    arcs,               // less than a full turn
    arcs_on_a,          // as far as the arc's middle lies along A: cos^2 of it
    arcs_on_b,          // along B: sin^2
    arcs_on_axes,       // along an axis: cos^2 of twice the middle
    arcs_on_diagonals,  // between them: sin^2
  };
  std::vector<double> gains;  // the sum, a number for each gain
  double readings = 0.0;
  Where where = Where::arcs;
};

// Which dictionary of a regression that predicts without naming a cause an effect belongs to (effect_regression.hpp).
enum class PredictorKind {
  source,       // of heat: speed, load
  temperature,  // what follows one temperature
  feedback,     // sources whose heat is more, or passes otherwise, in some states
  difference,   // of two temperatures
  start,        // a temperature as a run begins: no effect of the catalogue, and only where there are several runs
};

// How an effect takes part in such a regression: a unit of its first gain at these shapes.
struct PredictorRule {
  PredictorKind kind = PredictorKind::source;
  std::vector<std::vector<double>> grid;  // values of each of its shapes; every combination
  std::string difference_of = {};  // effect of one input: on the first of this one's inputs less on the second, at the
                                   // same shapes, it is this effect
};

// What searches, tests and challenges are told of an effect.
struct EffectRules {
  bool is_base = false;    // in every model of its level: not searched, not tested by leaving it out
  bool of_set_up = false;  // of these data alone: no model that is kept has it
  // Of a base: names of its gains that recordings with one bar share, where they differ in feed.
  std::vector<std::string> one_for_all = {};
  bool may_repeat = false;           // searched beside itself on the same columns, with another onset or period
  bool first_input_warmest = false;  // on average; the other way round is the same with another sign
  // Shapes with which what its first gain adds goes with its first input, |cosine| about their means above this, are
  // left out: there it is another effect.
  std::optional<double> same_as_input = std::nullopt;
  std::string becomes = {};  // effect of its inputs, or of some, that it is at the edge of its shapes
  bool is_common = false;    // one that many machines have: how much of it could hide is always said
  ErrorFit error_fit = ErrorFit::none;
  double reversal_deg = 0.0;  // of an error of one axis: where the axis turns back at its + end, 0 (A) or 90 (B)
  std::vector<Damping> damping = {};
  RankedByInstrument ranked_by_instrument = RankedByInstrument::always;
  AxisRelation relation = AxisRelation::none;
  std::vector<ExplainedCause> explains = {};
  std::optional<PredictorRule> predictor = std::nullopt;
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
  EffectRules rules = {};
};

// Whether it acts in recordings that `motion` drives.
bool applies_to(const Effect& effect, Motion motion);

// Whether it has a time constant, a period, a moment or a rate: data without a clock cannot show it.
bool needs_clock(const Effect& effect);

// Effects to choose from. Values: a copy has the same effects, and adding to it changes no other.
using Catalogue = std::vector<std::shared_ptr<const Effect>>;

// Every effect of src/effects, drift series first, in the order of the documentation.
const Catalogue& built_in_catalogue();

// The effect of that name, or nullptr. `level` decides where both have one (bar_temperature).
const Effect* find_effect(std::string_view name, Level level, const Catalogue& catalogue = built_in_catalogue());

// The effect that every model of this level has; nullptr: none.
const Effect* base_effect(Level level, const Catalogue& catalogue);

}  // namespace ballbar
