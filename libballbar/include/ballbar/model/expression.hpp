// `expression`: an effect that the user writes as a formula, for what the catalogue does not have.
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
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/effects/effect.hpp"
#include "ballbar/model/model.hpp"

namespace ballbar {

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

}  // namespace ballbar
