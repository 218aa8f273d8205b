// A model of a measured column: a sum of effects, each bound to the columns that it reads, and a constant.
//
//   y(t) = c + sum over the terms of effect_k(columns of the data; parameters)      um
//
// A model is a value: it is copied, compared and written to a file (formats/models). It has no data. The same model
// serves the fit (fit.hpp), the search for what is missing (diagnose.hpp), predictions, and compensation on line.
//
//   term_of()          a term with the usual settings of an effect of the catalogue
//   expression_term()  a term from a formula of the user's own
//   expect_suits()     whether a model can be used on data
//   LiveModel          its value row by row, as signals arrive
//
//   Model model;
//   model.targets = {"Z_um"};
//   model.terms = {term_of("lagged_expansion", {"T_front_degC"})};
//   const Fit fitted = fit(model, data);
//
// Units: columns as their names say; values in um; settings in the unit of their parameter. Signs: a contribution adds
// to the target, so that a positive gain of a temperature is a target that grows as it warms.
//
// Accuracy: effects with a time constant use the exact response to inputs that are linear between rows, so that rows of
// uneven steps cause no error of their own. Rows on which an effect's 95 % interval is checked: tests/study,
// effects.cpp.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/effects/effect.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

// How one parameter enters a fit: held at `start`, or free from there within the bounds.
//
// A gain that is held at 0 switches its effect off. Bounds may be infinite. Where the start is stated, a fit follows
// this start alone; otherwise it follows the best points of the grid of the parameter.
struct Setting {
  bool held = false;
  double start = 0.0;
  double lower = 0.0;
  double upper = 0.0;
  bool stated = false;  // the user stated the start: the grid is not searched

  bool operator==(const Setting& other) const = default;
};

// An effect with its columns and settings. The label of a term is unique in a model.
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

// ---- An effect bound to the columns that it reads, without settings: what a search ranks and a diagnosis names. It
// points into a catalogue, which must outlive it.

struct BoundEffect {
  const Effect* effect = nullptr;
  std::vector<std::string> columns;  // as effect->inputs
  bool operator==(const BoundEffect&) const = default;
};
std::string label_of(const BoundEffect& bound);  // "lagged_expansion(T_air_degC)"

// ---- `expression`: an effect that the user writes as a formula, for what the catalogue does not have.
//
//   k * lag(T_oil_degC - T_air_degC, tau)
//
// A name is a parameter if the list of parameters has it. t is the time in s. Any other name is a column of the data,
// in any unit; it becomes an input with the column's name as its role. lag(x, tau) is the first-order low pass of x,
// which may be any sub-formula, also another lag. It uses the exact recursion for uneven steps that all effects share,
// with x linear between rows. tau is in s and may vary: each step takes the value at its end. For tau <= 0 the result
// is x. muParser evaluates the rest: + - * / ^, < <= > >= == !=, && ||, a ? b : c, _pi, _e and sin cos tan asin acos
// atan atan2 sinh cosh tanh asinh acosh atanh exp ln log (natural, as ln) log2 log10 sqrt abs sign rint min max sum
// avg. Assignments are not allowed.
//
// A parameter is a gain if the formula is linear in it, jointly with the gains before it: of a * b * x only a is a
// gain. This is tested on artificial rows at 0, 1, 2 and further values. Any other parameter is a shape. A gain of an
// expression need not start at 0.
//
// Derivatives are central differences within the bounds. They are exact to rounding for a gain, and to about 1e-8 of
// the value for a shape. Limits: 4096 bytes, 50 nested brackets, 20 lags, 20 parameters.

// The columns and parameters of a formula: all names that are not a function, a constant or t, each once, in order of
// appearance. Throws Error "formula, column 12: expected ..., found ...".
std::vector<std::string> names_in(std::string_view formula);

// The effect of a formula. Sets `kind` of the parameters by the test above, and explanation.formula. Throws Error as
// names_in() does, for a parameter that is unused or listed twice, and for too many parameters.
std::shared_ptr<const Effect> expression_of(std::string_view formula, std::vector<Parameter> parameters,
                                            Level level = Level::series);

// The term of a formula: columns bound by their names, starts as stated in `parameters`.
Term expression_term(std::string_view formula, std::vector<Parameter> parameters, Level level = Level::series);

// The catalogue page about expressions. It has no inputs, no parameters and cannot be evaluated.
const Effect& expression_page();

// Used by expect_suits(). Throws Error where the data lack a column of the formula (with its position and the nearest
// name), where a parameter has the name of a column, or where the value at the start is not finite.
void expect_expression_suits(const Term& term, const Series& data);

// ---- Evaluates a model row by row as its inputs arrive, in O(1) per row.
//
// The results equal those of predict() over the whole series, bit by bit. Effects with memory keep a few numbers
// between rows. Effects that need rows other than the first, the previous and the current one (clock_offset) cannot run
// live.

class LiveModel {
 public:
  // The state between rows, for storing. It holds rows 0, i - 1 and i, as far as they have arrived.
  struct State {
    std::size_t rows = 0;  // number of rows held, at most 3
    std::array<double, 3> time_s{};
    std::vector<double> inputs;  // three values per column, in the order of columns()
    std::vector<double> kept;    // memory of the effects, term by term
  };

  // Takes every parameter at its start value; a free constant is 0. Throws Error for a model of recordings and for an
  // effect that cannot run live.
  explicit LiveModel(const Model& model);
  LiveModel(const LiveModel&) = delete;
  LiveModel& operator=(const LiveModel&) = delete;

  // The columns that the model reads, each once.
  std::span<const std::string> columns() const { return columns_; }

  // The value of the model at this row, in um. The time must be after that of the previous row; `values` are finite, in
  // the order of columns(). Allocates no memory. A row with a result that is not finite does not change the state.
  double next(double time_s, std::span<const double> values);

  // n rows at once, on all cores; the same results as row by row. values: n of each of columns(). contributions_um: n
  // values of the first term, then n of the second, and so on. Returns false and changes nothing if a result may not be
  // finite; pass the rows one by one then.
  bool next(std::span<const double> time_s, std::span<const std::span<const double>> values,
            std::span<double> contributions_um);

  // Contribution of each term to the last row that was passed by itself, in um.
  std::span<const double> contributions_um() const { return contributions_um_; }

  const State& state() const { return state_; }

  // Treats the next row as the first.
  void begin_anew() { state_.rows = 0; }

  // Restores a stored state. Throws Error if it does not fit this model: other sizes, more than 3 rows, or times that
  // do not rise.
  void resume(const State& state);

 private:
  struct LiveTerm {
    Evaluate evaluate;
    std::vector<double> parameters;
    std::vector<std::size_t> column;  // index into columns_ of each input of the effect
    std::size_t kept = 0;             // where its memory begins in State::kept
    EffectRows rows;                  // points into state_; updated when the number of rows changes
  };

  double value_at(std::size_t row);
  void show_rows();

  double constant_um_ = 0.0;
  std::vector<std::string> columns_;
  std::vector<LiveTerm> terms_;
  State state_, before_;
  std::size_t shown_rows_ = 0;
  std::vector<double> contributions_um_;
};

}  // namespace ballbar
