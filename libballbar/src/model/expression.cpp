#include <fmt/format.h>
#include <fmt/ranges.h>
#include <muParser.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <utility>

#include "ballbar/error.hpp"
#include "ballbar/internal/nearest_name.hpp"
#include "ballbar/model/model.hpp"
#include "effects/low_pass.hpp"
#include "model/expression_linearity.hpp"
#include "model/formula.hpp"
#include "model/measured_input.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kMostParameters = 20;
constexpr std::string_view kOnset = "onset_s";  // the name of a parameter that is one
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

// What each name of the formula stands for.
struct Binding {
  bool parameter = false;
  std::size_t index = 0;  // of the parameters, or of the inputs
};

struct Bound {
  Formula formula;
  std::vector<Binding> names;  // as formula.names
};

// muParser's compiled texts and the variables that they read. Not shared: each evaluation has its own.
class Program {
 public:
  explicit Program(const Bound& bound)
      : bound_(bound),
        name_(bound.names.size()),
        lag_(bound.formula.lags.size()),
        inputs_(lag_.size()),
        time_constants_(lag_.size()) {
    for (std::size_t k = 0; k < lag_.size(); ++k) {
      compile(inputs_[k], bound.formula.lags[k].input);
      compile(time_constants_[k], bound.formula.lags[k].time_constant_s);
    }
    compile(whole_, bound.formula.text);
  }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  std::size_t kept() const { return lag_.size() * kLagKept; }

  double at(const EffectRows& rows, std::size_t i, const double* parameters, double* kept) {
    time_s_ = rows.time_s[i];
    for (std::size_t k = 0; k < name_.size(); ++k) {
      const Binding& binding = bound_.names[k];
      name_[k] = binding.parameter ? parameters[binding.index] : rows.inputs[binding.index][i];
    }
    for (std::size_t k = 0; k < lag_.size(); ++k) lag_[k] = lag_at(k, rows, i, kept + k * kLagKept);
    return whole_.Eval();
  }

  void run(const EffectRows& rows, const double* parameters, double* values) {
    std::vector<double> numbers(kept());
    for (std::size_t i = 0; i < rows.time_s.size(); ++i) values[i] = at(rows, i, parameters, numbers.data());
  }

 private:
  void compile(mu::Parser& parser, const std::string& text) {
    parser.DefineVar(std::string(kFormulaTime), &time_s_);
    for (std::size_t i = 0; i < name_.size(); ++i) parser.DefineVar(fmt::format("{}{}", kFormulaName, i), &name_[i]);
    for (std::size_t i = 0; i < lag_.size(); ++i) parser.DefineVar(fmt::format("{}{}", kFormulaLag, i), &lag_[i]);
    parser.SetExpr(text);
    parser.Eval();  // compiles
  }

  // low_pass_at() with a time constant of each row, kept too; lags before this one are known.
  double lag_at(std::size_t k, const EffectRows& rows, std::size_t i, double* kept) {
    const double input = inputs_[k].Eval();
    const double tau_s = time_constants_[k].Eval();
    double& last_tau_s = kept[kLowPassKept];
    low_pass_at(rows, i, input, std::max(0.0, tau_s), i == 0 || tau_s != last_tau_s, kept);
    last_tau_s = tau_s;
    if (std::isnan(tau_s)) kept[0] = kNone;
    return kept[0];
  }

  static constexpr std::size_t kLagKept = kLowPassKept + 1;

  const Bound& bound_;
  double time_s_ = 0.0;
  std::vector<double> name_, lag_;  // variables; never resized, muParser points into them
  std::vector<mu::Parser> inputs_, time_constants_;
  mu::Parser whole_;
};

// Central differences, inside the bounds as far as they leave room.
Evaluate evaluated_by(std::shared_ptr<const Bound> bound, std::vector<Parameter> parameters) {
  // One program for all rows that arrive; who asks for others waits.
  struct Live {
    explicit Live(std::shared_ptr<const Bound> of) : bound(std::move(of)), program(*bound) {}
    std::shared_ptr<const Bound> bound;
    Program program;
    std::mutex at_work;
  };
  const auto live = std::make_shared<Live>(bound);
  const auto some = [live](const EffectRows& rows, std::size_t begin, std::size_t end, const double* p, double* kept,
                           double* values) {
    const std::lock_guard<std::mutex> alone(live->at_work);
    for (std::size_t i = begin; i < end; ++i) values[i - begin] = live->program.at(rows, i, p, kept);
  };
  const std::size_t kept = live->program.kept(), count = parameters.size();
  const auto all = [bound = std::move(bound), parameters = std::move(parameters)](
                       const EffectRows& rows, const double* p, double* values, double* derivatives) {
    Program program(*bound);
    program.run(rows, p, values);
    if (derivatives == nullptr) return;
    const std::size_t n = rows.time_s.size();
    std::vector<double> at(p, p + parameters.size()), above(n), below(n);
    for (std::size_t k = 0; k < parameters.size(); ++k) {
      const Parameter& parameter = parameters[k];
      const bool gain = parameter.kind == ParameterKind::gain;
      const double size = p[k] != 0.0 ? std::abs(p[k]) : parameter.start != 0.0 ? std::abs(parameter.start) : 1.0;
      const double step = gain ? std::max(1.0, size) : 6e-6 * size;
      double high = gain ? p[k] + step : std::min(p[k] + step, parameter.upper);
      double low = gain ? p[k] - step : std::max(p[k] - step, parameter.lower);
      if (!(low < high)) {
        high = p[k] + step;
        low = p[k] - step;
      }
      at[k] = high;
      program.run(rows, at.data(), above.data());
      at[k] = low;
      program.run(rows, at.data(), below.data());
      at[k] = p[k];
      for (std::size_t i = 0; i < n; ++i) {
        derivatives[i * parameters.size() + k] = (above[i] - below[i]) / (high - low);
      }
    }
  };
  return {all, some, kept, count};
}

Explanation page() {
  return {
      .summary = "What the user writes: a formula over columns, time and parameters, with lag.",
      .cause = "Whatever the catalogue does not have.",
      .formula = "k * lag(T_oil_degC - T_air_degC, tau)",
      .signature = "That of the formula.",
      .confused_with = {},
      .separated_by = "What the data cannot separate is computed from the data, as for every effect.",
      .remedy = "That of the cause that the formula stands for.",
      .validity =
          "Names are columns of the data, the effect's own parameters, or t in s; lag(x, tau) is the first-order low "
          "pass of x with tau in s; functions are those of muParser, log is the natural one. At most 4096 bytes, 50 "
          "brackets in one another, 20 lags and 20 parameters.",
      .source = "The user's; it is evaluated by muParser.",
  };
}

[[noreturn]] void fail_in_formula(const Term& term, std::size_t column, std::string_view sentence) {
  throw Error(fmt::format("{}: formula, column {}: {}", label_of(term), column, sentence));
}

void expect_finite(const Term& term, const Series& data) {
  EffectRows rows;
  std::vector<std::vector<double>> columns;
  for (const std::string& name : term.columns) {
    const Column& column = *find_column(data, name);
    columns.push_back(term.effect->level == Level::series ? input_values(data, column) : column.values);
  }
  std::vector<double> time_s;
  std::vector<std::vector<double>> inputs(columns.size());
  for (std::size_t i = 0; i < data.time_s.size(); ++i) {  // without the gaps
    const auto known = [&](const std::vector<double>& values) { return std::isfinite(values[i]); };
    if (!std::all_of(columns.begin(), columns.end(), known)) continue;
    time_s.push_back(data.time_s[i]);
    for (std::size_t k = 0; k < inputs.size(); ++k) inputs[k].push_back(columns[k][i]);
  }
  rows.time_s = time_s;
  for (const std::vector<double>& input : inputs) rows.inputs.emplace_back(input);
  std::vector<double> starts, values(time_s.size());
  for (const Setting& setting : term.settings) starts.push_back(setting.start);
  term.effect->evaluate(rows, starts.data(), values.data(), nullptr);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isfinite(values[i])) continue;
    throw Error(fmt::format("{}: expected finite values where the parameters start, found {} at {} s.", label_of(term),
                            std::isnan(values[i]) ? std::abs(values[i]) : values[i], time_s[i]));
  }
}

}  // namespace

std::vector<std::string> names_in(std::string_view formula) {
  std::vector<std::string> names;
  for (Formula::Name& name : parse_formula(formula).names) names.push_back(std::move(name.name));
  return names;
}

std::shared_ptr<const Effect> expression_of(std::string_view formula, std::vector<Parameter> parameters, Level level) {
  auto bound = std::make_shared<Bound>(Bound{parse_formula(formula), {}});
  if (parameters.size() > kMostParameters) {
    throw Error(
        fmt::format("expression: expected at most {} parameters, found {}.", kMostParameters, parameters.size()));
  }
  const auto index_of = [&](std::string_view name) {
    const auto found =
        std::find_if(parameters.begin(), parameters.end(), [&](const auto& p) { return p.name == name; });
    return static_cast<std::size_t>(found - parameters.begin());
  };
  auto effect = std::make_shared<Effect>();
  effect->name = "expression";
  effect->level = level;
  effect->explanation = page();
  effect->explanation.formula = formula;
  std::vector<bool> used(parameters.size());
  for (const Formula::Name& name : bound->formula.names) {
    const std::size_t index = index_of(name.name);
    const bool parameter = index < parameters.size();
    bound->names.push_back({parameter, parameter ? index : effect->inputs.size()});
    if (parameter) {
      used[index] = true;
    } else {
      effect->inputs.push_back({name.name, {}, "column of the formula"});
    }
  }
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    const std::string& name = parameters[k].name;
    if (index_of(name) != k)
      throw Error(fmt::format("expression: expected each parameter once, found {} again.", name));
    if (!used[k]) throw Error(fmt::format("expression: expected the parameter {} in the formula, found none.", name));
  }
  effect->time_only = effect->inputs.empty();
  try {
    Program program(*bound);
    find_kinds(parameters, effect->inputs,
               [&](const EffectRows& rows, const double* p, double* values) { program.run(rows, p, values); });
  } catch (const mu::Parser::exception_type& error) {
    throw Error(fmt::format("formula: expected one that muParser takes, found what it says of it: {}", error.GetMsg()));
  }
  for (Parameter& parameter : parameters) {
    if (parameter.name == kOnset) parameter.shape_of = ShapeOf::onset;
  }
  effect->evaluate = evaluated_by(std::move(bound), parameters);
  effect->parameters = std::move(parameters);
  return effect;
}

Term expression_term(std::string_view formula, std::vector<Parameter> parameters, Level level) {
  Term term{expression_of(formula, std::move(parameters), level), {}, {}};
  for (const Input& input : term.effect->inputs) term.columns.push_back(input.role);
  for (const Parameter& parameter : term.effect->parameters) {
    term.settings.push_back({parameter.held, parameter.start, parameter.lower, parameter.upper, true});
  }
  return term;
}

const Effect& expression_page() {
  static const Effect kPage = [] {
    Effect effect;
    effect.name = "expression";
    effect.explanation = page();
    return effect;
  }();
  return kPage;
}

void expect_expression_suits(const Term& term, const Series& data) {
  std::vector<std::string_view> known{kFormulaTime};
  for (const Parameter& parameter : term.effect->parameters) known.push_back(parameter.name);
  for (const Column& column : data.columns) known.push_back(column.name);
  for (const Formula::Name& name : parse_formula(term.effect->explanation.formula).names) {
    const bool is_column = find_column(data, name.name) != nullptr;
    const auto& parameters = term.effect->parameters;
    const bool is_parameter =
        std::any_of(parameters.begin(), parameters.end(), [&](const auto& p) { return p.name == name.name; });
    if (is_parameter && is_column) {
      fail_in_formula(term, name.column,
                      fmt::format("expected a parameter whose name is not that of a column, found {}, which the data "
                                  "has too.",
                                  in_quotes(name.name)));
    }
    if (is_parameter || is_column) continue;
    fail_in_formula(term, name.column,
                    fmt::format("expected a column of the data, a parameter of the effect or t, found {}; the nearest "
                                "known name is {}.",
                                in_quotes(name.name), nearest_name(name.name, known)));
  }
  expect_finite(term, data);
}

}  // namespace ballbar
