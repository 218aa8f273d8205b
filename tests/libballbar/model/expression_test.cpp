#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "ballbar/error.hpp"
#include "ballbar/model/model.hpp"

namespace ballbar {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Parameter free_parameter(std::string name, double start, double lower = -kInfinity, double upper = kInfinity) {
  return {.name = std::move(name), .unit = "1", .start = start, .lower = lower, .upper = upper};
}

// Values of a formula over t, x_um and y_um.
struct Rows {
  std::vector<double> time_s{0.0, 10.0, 40.0, 50.0};  // uneven
  std::vector<double> x_um{1.0, 3.0, 0.0, 5.0};
  std::vector<double> y_um{2.0, 2.0, 4.0, 4.0};

  EffectRows of(const Effect& effect) const {
    EffectRows rows{time_s, {}};
    for (const Input& input : effect.inputs) rows.inputs.emplace_back(input.role == "x_um" ? x_um : y_um);
    return rows;
  }

  std::vector<double> values(std::string_view formula, std::vector<Parameter> parameters = {},
                             std::vector<double> at = {}) const {
    const auto effect = expression_of(formula, std::move(parameters));
    std::vector<double> out(time_s.size());
    effect->evaluate(of(*effect), at.data(), out.data(), nullptr);
    return out;
  }

  double first(std::string_view formula) const { return values(formula)[0]; }
};

std::string complaint(std::string_view formula, std::vector<Parameter> parameters = {}) {
  try {
    expression_of(formula, std::move(parameters));
  } catch (const Error& error) {
    return error.what();
  }
  return "taken";
}

TEST(expression, names_are_columns_parameters_and_time) {
  const auto effect = expression_of("k * (y_um - x_um) + y_um + t", {free_parameter("k", 0.5)});
  ASSERT_EQ(effect->inputs.size(), 2u);
  EXPECT_EQ(effect->name, "expression");
  EXPECT_EQ(effect->inputs[0].role, "y_um");
  EXPECT_EQ(effect->inputs[1].role, "x_um");
  EXPECT_TRUE(effect->inputs[0].units.empty());
  EXPECT_FALSE(effect->time_only);
  EXPECT_TRUE(expression_of("t", {})->time_only);
  EXPECT_EQ(Rows{}.values("k * (y_um - x_um) + y_um + t", {free_parameter("k", 0.5)}, {0.5}),
            (std::vector<double>{2.5, 11.5, 46.0, 53.5}));
  EXPECT_EQ(names_in("k * lag(sin(x_um), tau) + _pi * k + t"), (std::vector<std::string>{"k", "x_um", "tau"}));
  EXPECT_EQ(names_in("\u0394T_K\u00B2"), (std::vector<std::string>{"\u0394T_K\u00B2"}));
}

// muParser's rules, as promised: a power before its sign and from the right, comparisons are 1 or 0.
TEST(expression, arithmetic) {
  const Rows rows;
  const std::pair<std::string_view, double> kValues[] = {{"2 + 3 * 4", 14.0},
                                                         {"-2 ^ 2", -4.0},
                                                         {"2 ^ 3 ^ 2", 512.0},
                                                         {"2 ^ -1", 0.5},
                                                         {"3 * -y_um", -6.0},
                                                         {"+1.5e1", 15.0},
                                                         {".5", 0.5},
                                                         {"y_um > x_um ? 7 : 8", 7.0},
                                                         {"y_um<x_um?7:y_um==2?9:10", 9.0},
                                                         {"1 < 2 && 0 || 3 >= 3", 1.0},
                                                         {"1 != 1", 0.0},
                                                         {"min(3, x_um, 2)", 1.0},
                                                         {"max(3)", 3.0},
                                                         {"sum(1, 2, 3)", 6.0},
                                                         {"avg(1, 2)", 1.5},
                                                         {"sin(_pi / 2)", 1.0},
                                                         {"ln(_e)", 1.0},
                                                         {"log(_e)", 1.0},
                                                         {"log10(100)", 2.0},
                                                         {"log2(8)", 3.0},
                                                         {"exp(0)", 1.0},
                                                         {"sqrt(16)", 4.0},
                                                         {"abs(-3)", 3.0},
                                                         {"sign(-3)", -1.0},
                                                         {"rint(2.4)", 2.0},
                                                         {"atan2(1, 1)", std::atan(1.0)},
                                                         {"cos(0) + tan(0)", 1.0},
                                                         {"asin(1) - acos(0)", 0.0},
                                                         {"atan(1)", std::atan(1.0)},
                                                         {"sinh(0) + cosh(0) + tanh(0)", 1.0},
                                                         {"asinh(0) + acosh(1) + atanh(0)", 0.0},
                                                         {"((((1))))", 1.0},
                                                         {"1e-300 * 1e300", 1.0},
                                                         {"1 \t\n+\r2", 3.0}};
  for (const auto& [formula, value] : kValues) EXPECT_DOUBLE_EQ(rows.first(formula), value) << formula;
}

// Steps of 10, 30, 10 s with tau = 20 s. A step of dt takes the state x and the input from u to v to
//   x + a (u - x) + (v - u) (1 - a tau / dt),   a = 1 - exp(-dt / tau):
// a_10 = 1 - e^-0.5 = 0.3934693402873666, 1 - 2 a_10 = 0.2130613194252668
// a_30 = 1 - e^-1.5 = 0.7768698398515702, 1 - (2/3) a_30 = 0.4820867734322865
//   x_0 = 1
//   x_1 = 1 + 0 + 2 * 0.2130613194252668                                       = 1.4261226388505336
//   x_2 = x_1 + 0.7768698398515702 (3 - x_1) - 3 * 0.4820867734322865            = 1.2025602...
//   x_3 = x_2 + 0.3934693402873666 (0 - x_2) + 5 * 0.2130613194252668
TEST(expression, lag_on_uneven_rows_is_exact) {
  const double a_10 = 0.3934693402873666, a_30 = 0.7768698398515702;
  const double x_1 = 1.4261226388505336;
  const double x_2 = x_1 + a_30 * (3.0 - x_1) - 3.0 * 0.4820867734322865;
  const double x_3 = x_2 - a_10 * x_2 + 5.0 * 0.2130613194252668;
  const std::vector<double> lagged = Rows{}.values("lag(x_um, tau)", {free_parameter("tau", 20.0)}, {20.0});
  EXPECT_NEAR(lagged[0], 1.0, 1e-14);
  EXPECT_NEAR(lagged[1], x_1, 1e-14);
  EXPECT_NEAR(lagged[2], x_2, 1e-14);
  EXPECT_NEAR(lagged[3], x_3, 1e-14);
  EXPECT_NEAR(lagged[2], 1.2025602, 1e-7);
}

TEST(expression, lag_of_any_formula_nested_and_of_a_lag) {
  const Rows rows;
  // A straight line lags by tau once the start has died out: u = t, x = t - tau (1 - exp(-t / tau)).
  EXPECT_NEAR(rows.values("lag(t, 5)")[3], 50.0 - 5.0 * (1.0 - std::exp(-10.0)), 1e-12);
  // A sum is lagged as its parts are.
  const std::vector<double> sum = rows.values("lag(x_um + 2 * y_um, 15) - lag(x_um, 15) - 2 * lag(y_um, 15)");
  for (const double value : sum) EXPECT_NEAR(value, 0.0, 1e-14);
  // The inner lag of a constant is that constant, so the outer one sees x_um + 3.
  const std::vector<double> nested = rows.values("lag(lag(3, 7) + x_um, 20) - lag(x_um, 20)");
  for (const double value : nested) EXPECT_NEAR(value, 3.0, 1e-14);
  // At or below 0 it is its input.
  EXPECT_EQ(rows.values("lag(x_um, 0)"), rows.x_um);
  EXPECT_EQ(rows.values("lag(x_um, -3)"), rows.x_um);
  // A varying tau acts at the end of a step: the first step's is 20 s, the second's is 0.
  EXPECT_NEAR(rows.values("lag(x_um, y_um < 3 ? 20 : 0)")[1], 1.4261226388505336, 1e-14);
  EXPECT_EQ(rows.values("lag(x_um, y_um < 3 ? 20 : 0)")[2], 0.0);
}

TEST(expression, lag_is_that_of_the_catalogue) {
  const Effect& lagged = *find_effect("lagged_expansion", Level::series);
  const Rows rows;
  const double parameters[] = {2.5, 33.0};
  std::vector<double> catalogue(rows.time_s.size());
  lagged.evaluate({rows.time_s, {rows.x_um}}, parameters, catalogue.data(), nullptr);
  const std::vector<double> own = rows.values("2.5 * (lag(x_um, 33) - 1)");  // x_um starts at 1
  for (std::size_t i = 0; i < own.size(); ++i) EXPECT_NEAR(own[i], catalogue[i], 1e-13);
}

// d/dk = LP - y, d/dtau from a fourth-order difference, d/dp of y^p = y^p ln y.
TEST(expression, derivatives) {
  const auto effect = expression_of(
      "k * (lag(x_um, tau) - y_um) + y_um ^ p",
      {free_parameter("k", 0.0), free_parameter("tau", 20.0, 1.0, 1e4), free_parameter("p", 1.5, 1.0, 3.0)});
  const Rows rows;
  const EffectRows effect_rows = rows.of(*effect);
  const std::size_t n = rows.time_s.size();
  const double at[] = {3.0, 20.0, 1.5};
  std::vector<double> values(n), derivatives(3 * n);
  effect->evaluate(effect_rows, at, values.data(), derivatives.data());
  const std::vector<double> lagged = rows.values("lag(x_um, 20)");
  const auto lag_at = [&](double tau_s) {
    return rows.values("lag(x_um, tau)", {free_parameter("tau", 20.0)}, {tau_s});
  };
  const double h = 0.05;
  const auto m2 = lag_at(20.0 - 2 * h), m1 = lag_at(20.0 - h), p1 = lag_at(20.0 + h), p2 = lag_at(20.0 + 2 * h);
  for (std::size_t i = 0; i < n; ++i) {
    EXPECT_NEAR(derivatives[3 * i], lagged[i] - rows.y_um[i], 1e-12);
    EXPECT_NEAR(derivatives[3 * i + 1], 3.0 * (m2[i] - 8.0 * m1[i] + 8.0 * p1[i] - p2[i]) / (12.0 * h), 1e-8);
    EXPECT_NEAR(derivatives[3 * i + 2], std::pow(rows.y_um[i], 1.5) * std::log(rows.y_um[i]), 1e-8);
  }
  // On a bound, from the inside: below 0 there is no square root.
  const auto root = expression_of("sqrt(p) * x_um", {free_parameter("p", 0.0, 0.0, 9.0)});
  const double zero = 0.0;
  std::vector<double> out(n);
  root->evaluate(rows.of(*root), &zero, values.data(), out.data());
  EXPECT_TRUE(std::isfinite(out[0]));
}

TEST(expression, a_parameter_is_a_gain_where_the_formula_is_straight_in_it) {
  const auto kinds = [](std::string_view formula, std::vector<Parameter> parameters) {
    std::string text;
    const auto effect = expression_of(formula, std::move(parameters));
    for (const Parameter& parameter : effect->parameters) {
      text += parameter.kind == ParameterKind::gain ? 'g' : 's';
    }
    return text;
  };
  const Parameter a = free_parameter("a", 0.0), b = free_parameter("b", 1.0);
  const Parameter tau = free_parameter("tau", 600.0, 10.0, 20000.0);
  EXPECT_EQ(kinds("a * lag(T_oil_degC - T_air_degC, tau)", {a, tau}), "gs");
  EXPECT_EQ(kinds("a * x_um + b * t", {a, b}), "gg");
  EXPECT_EQ(kinds("lag(a * x_um + b, 600)", {a, b}), "gg");
  EXPECT_EQ(kinds("a * b * x_um", {a, b}), "gs");
  EXPECT_EQ(kinds("a * b * x_um", {b, a}), "gs");
  EXPECT_EQ(kinds("a * speed_rpm ^ b", {a, b}), "gs");
  EXPECT_EQ(kinds("a * max(0, T_oil_degC - b)", {a, b}), "gs");
  EXPECT_EQ(kinds("a * (t > b)", {a, free_parameter("b", 3600.0, 0.0, 1e5)}), "gs");
  EXPECT_EQ(kinds("x_um / a", {a}), "s");
  EXPECT_EQ(kinds("abs(a) * x_um", {a}), "s");
  EXPECT_EQ(kinds("sqrt(a) * x_um", {a}), "s");
}

TEST(expression, errors_have_their_place_in_the_formula) {
  const std::pair<std::string, std::string> kBad[] = {
      {"", "formula: expected a formula, found nothing."},
      {" \t", "formula: expected a formula, found nothing."},
      {std::string(4097, '1'), "formula: expected at most 4096 bytes, found 4097."},
      {"(x_um + 1", "formula, column 10: expected \")\" for the \"(\" at column 1, found the end."},
      {"x_um + 1)", "formula, column 9: expected \"(\" before its \")\", found none."},
      {"x_um +", "formula, column 7: expected a value, found the end."},
      {"x_um * * 2", "formula, column 8: expected a value, found \"*\"."},
      {"* x_um", "formula, column 1: expected a value, found \"*\"."},
      {"- - x_um", "formula, column 3: expected a value, found \"-\"."},
      {"x_um y_um", "formula, column 6: expected an operator, found \"y_um\"."},
      {"2x_um", "formula, column 2: expected an operator, found \"x_um\"."},
      {"x_um 2", "formula, column 6: expected an operator, found \"2\"."},
      {"x_um (2)",
       "formula, column 1: expected one of the functions lag, sin, cos, tan, asin, acos, atan, sinh, cosh, "
       "tanh, asinh, acosh, atanh, atan2, exp, ln, log, log2, log10, sqrt, abs, sign, rint, min, max, sum, "
       "avg, found \"x_um\"; the nearest known name is sum."},
      {"2 (3)", "formula, column 3: expected an operator, found \"(\"."},
      {"()", "formula, column 2: expected a value, found \")\"."},
      {"(1 + )", "formula, column 6: expected a value, found \")\"."},
      {"lag(x_um)", "formula, column 9: expected 2 arguments of lag, found 1."},
      {"lag()", "formula, column 5: expected 2 arguments of lag, found none."},
      {"lag(x_um, 2, 3)", "formula, column 12: expected 2 arguments of lag, found 3."},
      {"lag(x_um,)", "formula, column 10: expected a value, found \")\"."},
      {"sin()", "formula, column 5: expected 1 argument of sin, found none."},
      {"sin(1, 2)", "formula, column 9: expected 1 argument of sin, found 2."},
      {"max()", "formula, column 5: expected at least 1 argument of max, found none."},
      {"max(,1)", "formula, column 5: expected a value, found \",\"."},
      {"sin + 1", "formula, column 4: expected \"(\" after the function sin, found \"+\"."},
      {"1 + lag", "formula, column 8: expected \"(\" after the function lag, found the end."},
      {"1,5 * x_um",
       "formula, column 2: expected \",\" only between the arguments of a function, found one elsewhere; decimals need "
       "a point."},
      {"(1,5)",
       "formula, column 3: expected \",\" only between the arguments of a function, found one elsewhere; decimals need "
       "a point."},
      {"x_um = 2", "formula, column 6: expected \"==\" to compare, found \"=\"; a formula assigns nothing."},
      {"x_um += 2", "formula, column 7: expected \"==\" to compare, found \"=\"; a formula assigns nothing."},
      {"\"x\"", "formula, column 1: expected a name, a number, an operator or a bracket, found \"\"\"."},
      {"!x_um", "formula, column 1: expected a name, a number, an operator or a bracket, found \"!\"."},
      {"x_um & 1", "formula, column 6: expected a name, a number, an operator or a bracket, found \"&\"."},
      {"x_um ? 1", "formula, column 9: expected \":\" after \"?\", found the end."},
      {"(x_um ? 1) : 2", "formula, column 10: expected \":\" after \"?\", found \")\"."},
      {"max(x_um ? 1, 2)", "formula, column 13: expected \":\" after \"?\", found \",\"."},
      {"x_um : 1", "formula, column 6: expected \"?\" before \":\", found none."},
      {"1e999 * x_um", "formula, column 1: expected a number that a double can hold, found \"1e999\"."},
      {"1 + .", "formula, column 5: expected a digit beside the point, found none."},
      {"0x10", "formula, column 2: expected an operator, found \"x10\"."},
      {"\u00B5 \u2212 1", "formula, column 3: expected an operator, found \"\u2212\"."},
      {std::string("x\0y", 3),
       "formula, column 2: expected a name, a number, an operator or a bracket, found \"\\x00\"."},
      {std::string(51, '(') + "1" + std::string(51, ')'),
       "formula, column 51: expected at most 50 brackets in one another, found more."},
  };
  for (const auto& [formula, message] : kBad) EXPECT_EQ(complaint(formula), message) << formula;
  std::string lags = "0";
  for (int i = 0; i < 21; ++i) lags += "+lag(t,1)";
  EXPECT_EQ(complaint(lags), "formula, column 190: expected at most 20 lags in one formula, found more.");
}

TEST(expression, errors_of_parameters) {
  EXPECT_EQ(complaint("x_um", {free_parameter("k", 0.0)}),
            "expression: expected the parameter k in the formula, found none.");
  EXPECT_EQ(complaint("k * x_um", {free_parameter("k", 0.0), free_parameter("k", 1.0)}),
            "expression: expected each parameter once, found k again.");
  EXPECT_EQ(complaint("x_um", std::vector<Parameter>(21)), "expression: expected at most 20 parameters, found 21.");
}

TEST(expression, nothing_in_a_limit_takes_long_or_overflows) {
  EXPECT_EQ(complaint(std::string(50, '(') + "1" + std::string(50, ')')), "taken");
  std::string conditionals = "1";
  for (int i = 0; i < 400; ++i) conditionals += "?2:1";
  EXPECT_EQ(complaint(conditionals), "taken");
  std::string powers = "1";
  while (powers.size() < 4090) powers += "^1";
  EXPECT_EQ(complaint(powers), "taken");
  std::string arguments = "sum(1";
  while (arguments.size() < 4090) arguments += ",1";
  EXPECT_EQ(complaint(arguments + ")"), "taken");
  std::string names = "0";
  while (names.size() < 4080) names += "+n" + std::to_string(names.size());
  EXPECT_EQ(complaint(names), "taken");
}

TEST(expression, page) {
  EXPECT_EQ(expression_page().name, "expression");
  EXPECT_FALSE(expression_page().explanation.summary.empty());
  EXPECT_FALSE(expression_page().explanation.validity.empty());
  EXPECT_EQ(names_in(expression_page().explanation.formula),
            (std::vector<std::string>{"k", "T_oil_degC", "T_air_degC", "tau"}));
}

}  // namespace
}  // namespace ballbar
