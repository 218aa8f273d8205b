// `expression`: the effect that a user writes, so that the catalogue is never the limit.
//
//   k * lag(T_oil_degC - T_air_degC, tau)
//
// A name is a parameter where the list of parameters has it; t is the time in s; any other name is a column of the
// data and becomes an input whose role is the column's own name, in any unit. lag(x, tau) is the first-order low pass
// of x, of any sub-formula, with the exact recursion for uneven steps that all effects share, x a straight line between
// rows; it may stand in another lag. tau in s may vary: each step takes the value at its end; at or below 0 it gives x
// itself. muParser evaluates the rest: + - * / ^, < <= > >= == !=, && ||, a ? b : c, _pi, _e and sin cos tan asin acos
// atan atan2 sinh cosh tanh asinh acosh atanh exp ln log (natural, as ln) log2 log10 sqrt abs sign rint min max sum
// avg. Nothing is assigned.
//
// A parameter is a gain where the value is a straight line in it, probed on made-up rows at 0, 1, 2 and more values,
// and jointly so with the gains named before it (of a * b * x only a is one); any other is a shape. A gain of an
// expression need not start at 0.
//
// Derivatives are central differences within the bounds, exact but for rounding in a gain, to about 1e-8 of the value
// in a shape. Limits: 4096 bytes, 50 brackets in one another, 20 lags, 20 parameters.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/effects/effect.hpp"
#include "ballbar/model/model.hpp"

namespace ballbar {

// The names in a formula that are neither function nor constant nor t, each once, in its order: its columns and
// parameters. Throws Error "formula, column 12: expected ..., found ...".
std::vector<std::string> names_in(std::string_view formula);

// `kind` of the parameters is found by probing. The formula stands in explanation.formula. Throws Error as names_in;
// for a parameter that the formula does not use or that is there twice, and for too many.
std::shared_ptr<const Effect> expression_of(std::string_view formula, std::vector<Parameter> parameters,
                                            Level level = Level::series);

// Its term: columns bound by their names, starts stated.
Term expression_term(std::string_view formula, std::vector<Parameter> parameters, Level level = Level::series);

// The page of the catalogue about all of them; has no inputs, no parameters and nothing to evaluate.
const Effect& expression_page();

// Throws Error where data does not have a column of the formula, with its place in it and the nearest known name;
// where a parameter has the name of a column; where the value at the start is not finite. For expect_suits.
void expect_expression_suits(const Term& term, const Series& data);

}  // namespace ballbar
