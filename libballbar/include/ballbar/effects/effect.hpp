// One physical effect: its contribution to a measured series, and its documentation for the user.
//
// An effect is one constant value in one file of src/effects. That file holds everything about it: fits, searches and
// tests read the value, and no other code refers to an effect or a parameter by name. The same type serves a drift
// series (inputs: speed, temperatures ...) and a ballbar recording turned into a series (inputs: angle, direction, feed
// ...; see recording.hpp). A model is a sum of effects and a constant (model.hpp). A catalogue is a list of effects:
// the built-in one, or a user's own list, which may extend it.
//
// An effect returns one value in um per row of the data. It is evaluated over the whole series at once, so that an
// effect with memory is one recursion, O(n). A `gain` enters linearly and starts at 0, where the effect is off. A
// `shape` (time constant, exponent, threshold) enters nonlinearly and has a grid of start values.
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
inline std::string_view name_of(Level level) { return level == Level::series ? "series" : "recording"; }
enum class ParameterKind { gain, shape };

// The rows on which an effect is evaluated: n times and, in the order of Effect::inputs, n values of each input.
struct EffectRows {
  std::span<const double> time_s;  // rising; with several runs (series.hpp), rising within each
  std::vector<std::span<const double>> inputs;
  std::size_t run = 0;         // index of the run that these rows belong to
  std::vector<double> zero{};  // with several runs: each input in the first row of the first run; else empty
};

// The reference value of an input for effects with a threshold: its first value, with several runs that of the first
// run, because the threshold is a property of the machine.
inline double zero_of(const EffectRows& rows, std::size_t input) {
  return rows.zero.empty() ? rows.inputs[input][0] : rows.zero[input];
}

// What a shape parameter describes.
enum class ShapeOf {
  curve,      // a time constant, an exponent, a width ...
  onset,      // a moment in the time of the data, s; searched row by row and known to the distance of the rows
  period,     // the period of a periodic effect, s
  recording,  // index of the recording that a term belongs to, 0, 1 ...; -1: all. Held; shown in the term's label
};

// Whether the shape is a physical quantity rather than a moment or the index of a recording.
inline bool is_of_curve(ShapeOf shape_of) { return shape_of == ShapeOf::curve || shape_of == ShapeOf::period; }

// Start values to try on given rows, in the parameter's unit, within [lower, upper], at most `most` of them. For a
// periodic effect they are half the frequency resolution of the rows apart; a fit finds a sinusoid only from so near.
using GridOnRows =
    std::function<std::vector<double>(const EffectRows& rows, double lower, double upper, std::size_t most)>;

// A plausible value on given rows, in the parameter's unit; share 0 to 1 runs from the smallest to the largest.
using UsualOnRows = std::function<double(const EffectRows& rows, double share)>;

struct Parameter {
  std::string name;  // ends in its unit: "gain_um_per_K", "time_constant_s"
  std::string unit;  // as printed: "um/K", "s"; "1" for none
  ParameterKind kind = ParameterKind::gain;
  double start = 0.0;
  double lower = 0.0;  // bounds; may be infinite
  double upper = 0.0;
  std::vector<double> grid;  // shape: start values to try, rising; empty: only `start`
  std::string meaning;
  bool held = false;  // stays at `start` unless a model states otherwise
  ShapeOf shape_of = ShapeOf::curve;
  GridOnRows grid_on = {};    // replaces `grid` where the start values depend on the rows
  UsualOnRows usual_on = {};  // shape, for made data; empty: log-uniform from the second value of the grid to
                              // the last but one
  std::string row = {};       // gain of a machine error: its row in the table of errors, "pos" for "NAME_pos"; two
                              // gains with one row are sine and cosine of an amplitude
  double usual_low = 0.0, usual_high = 0.0;  // gain: the range of |value| on machines; both 0: not known
  std::string usual = {};                    // where that range comes from, a phrase
};

// Start values to try on these rows: those of `grid_on` or `grid` from `lower` to `upper`. Empty: only the parameter's
// own start.
std::vector<double> grid_of(const Parameter& parameter, const EffectRows& rows, double lower, double upper,
                            std::size_t most);

// A column that the effect reads. `role` is its key in a model file: temperature = "T_air_degC". In a search, and where
// the user names no column, the role tries every accepted column in one of the units, except targets and sigmas. On
// recordings it takes the column of the trace.
struct Input {
  std::string role;
  std::vector<std::string> units;  // accepted, as columns end: {"degC", "K"}
  std::string meaning;
  // Empty: accepts any column; of columns in um only an axial drift (z_um, axial_um, Z of five probes).
  std::function<bool(const Column& column)> accepts = {};
  bool of_another_effect = false;  // accepts only columns that an effect of the model reads
  std::string none_accepted = {};  // a phrase if units suit but no column is accepted: "no column of the bar"
};

// The page that `ballbar effects NAME` prints; whole sentences.
struct Explanation {
  std::string summary;  // one line
  std::string cause;
  std::string formula;                     // as evaluated, in the letters of the parameters
  std::string signature;                   // how it looks in a residual
  std::string on_parts;                    // of an error of the axes: what it does to interpolated circles and holes
  std::vector<std::string> confused_with;  // names of effects
  std::string separated_by;                // the test that tells them apart
  std::string remedy;                      // in the workshop
  std::string validity;
  std::string source;
};

// values: n. derivatives: n times the number of parameters, row by row; nullptr: not wanted.
using EvaluateAll =
    std::function<void(const EffectRows& rows, const double* parameters, double* values, double* derivatives)>;

// The values of rows i in [begin, end), for signals that arrive live. Row i may use only rows 0, i - 1 and i, and
// `kept`: the memory of the effect, which it sets at row 0. Pieces of any length give the results of EvaluateAll, bit
// by bit. Several threads may call it, each with its own `kept`.
using EvaluateRows = std::function<void(const EffectRows& rows, std::size_t begin, std::size_t end,
                                        const double* parameters, double* kept, double* values)>;

// Writes the contribution of a unit of each gain at this shape: n values of the first gain, then of the second ...
using UnitCurvesAt = std::function<void(double shape, double* curves)>;

// For a search over many shapes on the rows of one run: computes once what does not depend on the shape. The curves
// equal the derivatives of EvaluateAll with respect to the gains, up to rounding.
using UnitCurvesOn = std::function<UnitCurvesAt(const EffectRows& rows)>;

struct Evaluate {
  EvaluateAll all;
  EvaluateRows rows = {};         // empty: the effect needs other rows too
  std::size_t kept = 0;           // size of `kept`
  std::size_t parameters = 0;     // number of parameters; needed with several runs
  UnitCurvesOn unit_curves = {};  // for an effect with one shape; empty: the derivatives are used

  // With several runs the memory of the effect restarts at each run.
  void operator()(const EffectRows& rows, const double* at, double* values, double* derivatives) const;
};

// Causes of drift of a spindle that an effect explains.
enum class SpindleCause { centrifugal, rings, housing, structure, bending };

// A cause for which this effect is the right answer: only on the sensors of the parts that cause it, or on any columns.
struct ExplainedCause {
  SpindleCause cause = SpindleCause::centrifugal;
  bool on_its_sensors = false;
};

// The relation between the two axes of a plane that an error describes.
enum class AxisRelation {
  none,
  scale,  // how much longer A is than B over a diameter, um
  angle,  // angle from +A to +B minus 90 deg, um/m
};

// How an error of the machine is fitted (machine_errors.hpp).
enum class ErrorFit {
  none,              // not an error of the machine
  together,          // jointly with all others of this kind, on all readings away from reversals
  where_it_shows,    // jointly with them, only if it is significant and on full turns
  at_reversals,      // on their residual, within 9 deg of its own reversals; its shape is a width
  along_the_travel,  // on their residual, between reversals, for each recording; its shape is a wavelength
};

// When instrument software ranks an error of the machine.
enum class RankedByInstrument { always, on_full_turns, never };

// Regularisation of an error of the machine: a linear combination of its gains is pulled to 0 where the readings
// determine it poorly. The strength equals that of `readings` more readings of 0 at the most sensitive angle. Derived
// from the values that instrument software stores.
struct Damping {
  // The recordings to which it applies, and its weight there; phi is the angle of the middle of the arc.
  enum class Where {
    arcs,               // less than a full turn
    arcs_on_a,          // cos^2 phi: the middle lies along A
    arcs_on_b,          // sin^2 phi: the middle lies along B
    arcs_on_axes,       // cos^2 2 phi: the middle lies along an axis
    arcs_on_diagonals,  // sin^2 2 phi: the middle lies between the axes
  };
  std::vector<double> gains;  // coefficients of the linear combination, one per gain
  double readings = 0.0;
  Where where = Where::arcs;
};

// The group of predictors to which an effect belongs in a regression that predicts without naming causes
// (train.hpp).
enum class PredictorKind {
  source,       // of heat: speed, load
  temperature,  // an effect of one temperature
  feedback,     // a source whose heat or heat transfer depends on the state
  difference,   // a difference of two temperatures
  start,        // a temperature at the start of a run; not in the catalogue, only with several runs
};

// How an effect takes part in such a regression: its curve for a first gain of 1 at these shapes.
struct PredictorRule {
  PredictorKind kind = PredictorKind::source;
  std::vector<std::vector<double>> grid;  // values of each shape; every combination is used
  std::string difference_of = {};  // name of an effect of one input. This effect equals that one on its first input
                                   // minus that one on its second, at the same shapes
};

// Rules for searches, tests and made data.
struct EffectRules {
  bool is_base = false;    // part of every model of its level; not searched and not tested by leaving it out
  bool of_set_up = false;  // describes the set-up of these data; not written to model files
  // Base effect: names of the gains that recordings of one bar share if their feeds differ.
  std::vector<std::string> one_for_all = {};
  bool may_repeat = false;           // may occur twice on the same columns, with another onset or period
  bool first_input_warmest = false;  // the first input is the warmer one on average; swapping only changes the sign
  // Shapes at which the curve of the first gain correlates with the first input (|cosine| about the means) more than
  // this are left out: there the effect equals another one.
  std::optional<double> same_as_input = std::nullopt;
  std::string becomes = {};  // the effect of some or all of its inputs that it equals at the edge of its shapes
  bool is_common = false;    // occurs on many machines: a report always states how much of it could be undetected
  ErrorFit error_fit = ErrorFit::none;
  double reversal_deg = 0.0;  // error of one axis: angle at which the axis reverses at its + end, 0 (A) or 90 (B)
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
  bool time_only = false;            // depends on time alone: never named as a cause from one run
  std::vector<Motion> motions = {};  // motions of the recordings to which it applies; empty: any
  EffectRules rules = {};
};

// Whether the effect acts in recordings with this motion.
bool applies_to(const Effect& effect, Motion motion);

// Whether the effect has a time constant, a period, a moment or a rate. Data without a clock cannot show it.
bool needs_clock(const Effect& effect);

// A list of effects. A value: extending a copy does not change the original.
using Catalogue = std::vector<std::shared_ptr<const Effect>>;

// Every effect of src/effects, drift series first, in the order of the documentation.
const Catalogue& built_in_catalogue();

// The effect of that name, or nullptr. `level` decides if both levels have one (bar_temperature).
const Effect* find_effect(std::string_view name, Level level, const Catalogue& catalogue = built_in_catalogue());

// The base effect, which every model of this level has; nullptr: none.
const Effect* base_effect(Level level, const Catalogue& catalogue);

}  // namespace ballbar
