#include <fmt/format.h>
#include <fmt/ranges.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "ballbar/effects/effect.hpp"
#include "ballbar/error.hpp"
#include "python/arrays.hpp"
#include "python/classes.hpp"

namespace ballbar::python {
namespace {

namespace py = pybind11;

constexpr double kStep = 1e-5;  // of a shape, for its derivative: a share of its value, or of its range

// The function: called with the GIL, from whatever thread fits.
struct Function {
  std::string name;
  py::object call;
  std::size_t gains = 1;
  std::vector<std::pair<double, double>> bounds;  // of the shapes

  ~Function() {
    if (Py_IsInitialized() == 0) {  // the process ends
      call.release();
      return;
    }
    const py::gil_scoped_acquire hold;
    call = py::object();
  }
};

// What a function raised last, and what is said of it: the error may be put in other words on its way. With the GIL,
// and never deleted: Python may end first.
std::pair<std::string, py::object>& last_raised() {
  static auto* const last = new std::pair<std::string, py::object>;
  return *last;
}

// Ctrl-C and what else ends a program goes on as it is.
py::object answer_of(const Function& function, const py::list& arguments) {
  try {
    return function.call(*py::tuple(arguments));
  } catch (const py::error_already_set& error) {
    if (!error.matches(PyExc_Exception)) throw;
    const std::string type = py::str(error.type().attr("__name__")), text = py::str(error.value());
    const std::string sentence = fmt::format("{}: {}{}{}", function.name, type, text.empty() ? "" : ": ", text);
    if (error.trace()) PyException_SetTraceback(error.value().ptr(), error.trace().ptr());
    last_raised() = {sentence, error.value()};
    throw Error(sentence);
  }
}

// (n,) of one gain, (gains, n) of any number.
void expect_shape(const Function& function, const Numbers& answer, std::size_t n) {
  const std::vector<std::size_t> found(answer.shape(), answer.shape() + answer.ndim());
  if (found == std::vector{function.gains, n} || (function.gains == 1 && found == std::vector{n})) return;
  throw Error(fmt::format("{}: expected an array of shape ({}) from its function, found ({}).", function.name,
                          function.gains == 1 ? fmt::format("{},", n) : fmt::format("{}, {}", function.gains, n),
                          fmt::format("{}{}", fmt::join(found, ", "), found.size() == 1 ? "," : "")));
}

// n values of each gain for a unit of it, gain by gain.
std::vector<double> units_of(const Function& function, const EffectRows& rows, const double* shapes) {
  const py::gil_scoped_acquire hold;
  const auto copy = [](std::span<const double> values) {
    return py::array_t<double>(static_cast<py::ssize_t>(values.size()), values.data());
  };
  py::list arguments;
  arguments.append(copy(rows.time_s));
  for (const std::span<const double> input : rows.inputs) arguments.append(copy(input));
  for (std::size_t k = 0; k < function.bounds.size(); ++k) arguments.append(shapes[k]);
  const Numbers answer = numbers_of(answer_of(function, arguments), function.name);
  expect_shape(function, answer, rows.time_s.size());
  std::vector<double> values(answer.data(), answer.data() + answer.size());
  if (std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); })) return values;
  throw Error(fmt::format("{}: expected finite values from its function, found others.", function.name));
}

// Parameters: the gains, then the shapes.
void evaluate(const Function& function, const EffectRows& rows, const double* parameters, double* values,
              double* derivatives) {
  const std::size_t n = rows.time_s.size(), gains = function.gains, shapes = function.bounds.size();
  const double* const shape = parameters + gains;
  const auto summed = [&](const std::vector<double>& units, std::size_t i) {
    double sum = 0.0;
    for (std::size_t g = 0; g < gains; ++g) sum += parameters[g] * units[g * n + i];
    return sum;
  };
  const std::vector<double> units = units_of(function, rows, shape);
  for (std::size_t i = 0; i < n; ++i) values[i] = summed(units, i);
  if (derivatives == nullptr) return;
  const std::size_t all = gains + shapes;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t g = 0; g < gains; ++g) derivatives[i * all + g] = units[g * n + i];
  }
  for (std::size_t k = 0; k < shapes; ++k) {
    const auto [lower, upper] = function.bounds[k];
    const double size = std::abs(shape[k]) > 0.0       ? std::abs(shape[k])
                        : std::isfinite(upper - lower) ? upper - lower
                                                       : 1.0;
    std::vector<double> below(shape, shape + shapes), above = below;
    below[k] = std::max(lower, shape[k] - kStep * size);
    above[k] = std::min(upper, shape[k] + kStep * size);
    const std::vector<double> left = units_of(function, rows, below.data());
    const std::vector<double> right = units_of(function, rows, above.data());
    for (std::size_t i = 0; i < n; ++i) {
      derivatives[i * all + gains + k] = (summed(right, i) - summed(left, i)) / (above[k] - below[k]);
    }
  }
}

template <class Value>
Value as(py::handle value, const std::string& what, const char* expected) {
  try {
    return py::cast<Value>(value);
  } catch (const py::cast_error&) {
    throw Error(fmt::format("{}: expected {}, found {}.", what, expected, py::cast<std::string>(py::repr(value))));
  }
}

double number_of(const std::string& name, const py::dict& stated, const char* key, double otherwise) {
  return stated.contains(key) ? as<double>(stated[key], fmt::format("{}, {}", name, key), "a number") : otherwise;
}

std::string text_of(const py::dict& stated, const char* key, const std::string& otherwise) {
  return stated.contains(key) ? as<std::string>(stated[key], key, "a text") : otherwise;
}

Parameter parameter_of(const std::string& name, const py::dict& stated, ParameterKind kind) {
  constexpr double kLargest = 1e6;
  Parameter parameter;
  parameter.name = name;
  parameter.kind = kind;
  parameter.unit = text_of(stated, "unit", "1");
  parameter.meaning = text_of(stated, "meaning", name);
  const bool is_gain = kind == ParameterKind::gain;
  parameter.lower = number_of(name, stated, "lower", is_gain ? -kLargest : 0.0);
  parameter.upper = number_of(name, stated, "upper", kLargest);
  if (stated.contains("grid")) parameter.grid = as<std::vector<double>>(stated["grid"], name + ", grid", "numbers");
  parameter.start =
      is_gain ? 0.0 : number_of(name, stated, "start", parameter.grid.empty() ? 1.0 : parameter.grid.front());
  const bool rising = std::is_sorted(parameter.grid.begin(), parameter.grid.end());
  if (parameter.lower < parameter.upper && parameter.start >= parameter.lower && parameter.start <= parameter.upper &&
      rising) {
    return parameter;
  }
  throw Error(fmt::format("{}: expected lower < upper, a start between them and a rising grid, found {}, {}, {}.", name,
                          parameter.lower, parameter.upper, parameter.start));
}

std::shared_ptr<Effect> effect_of(const std::string& name, py::function call, const py::dict& inputs,
                                  const py::dict& gains, const py::dict& shapes, const py::dict& explanation) {
  auto effect = std::make_shared<Effect>();
  auto function = std::make_shared<Function>();
  effect->name = function->name = name;
  effect->explanation = {.summary = text_of(explanation, "summary", "An effect that the program was given."),
                         .cause = text_of(explanation, "cause", ""),
                         .formula = text_of(explanation, "formula", name + "(...)"),
                         .signature = text_of(explanation, "signature", ""),
                         .on_parts = text_of(explanation, "on_parts", ""),
                         .confused_with = {},
                         .separated_by = text_of(explanation, "separated_by", ""),
                         .remedy = text_of(explanation, "remedy", ""),
                         .validity = text_of(explanation, "validity", ""),
                         .source = text_of(explanation, "source", "a function of Python")};
  for (const auto& [role, units] : inputs) {
    const auto input = as<std::string>(role, "inputs", "the name of one");
    std::vector<std::string> accepted = py::isinstance<py::str>(units)
                                            ? std::vector<std::string>{py::cast<std::string>(units)}
                                            : as<std::vector<std::string>>(units, input, "a unit, or several");
    effect->inputs.push_back({input, std::move(accepted), input});
  }
  for (const auto& [gain, stated] : gains) {
    effect->parameters.push_back(
        parameter_of(py::cast<std::string>(gain), py::cast<py::dict>(stated), ParameterKind::gain));
  }
  function->gains = effect->parameters.size();
  for (const auto& [shape, stated] : shapes) {
    effect->parameters.push_back(
        parameter_of(py::cast<std::string>(shape), py::cast<py::dict>(stated), ParameterKind::shape));
    function->bounds.emplace_back(effect->parameters.back().lower, effect->parameters.back().upper);
  }
  if (name.empty() || function->gains == 0) {
    throw Error(fmt::format("{}: expected a name and at least one gain.", name.empty() ? "effect" : name));
  }
  effect->time_only = effect->inputs.empty();
  function->call = std::move(call);
  effect->evaluate.all = [function](const EffectRows& rows, const double* parameters, double* values,
                                    double* derivatives) {
    evaluate(*function, rows, parameters, values, derivatives);
  };
  effect->evaluate.parameters = effect->parameters.size();
  return effect;
}

}  // namespace

Catalogue catalogue_with(const Effects& effects) {
  Catalogue all = built_in_catalogue();
  for (const std::shared_ptr<Effect>& effect : effects) {
    if (find_effect(effect->name, effect->level, all) != nullptr) {
      throw Error(
          fmt::format("{}: expected a name of its own, found that of an effect of the catalogue.", effect->name));
    }
    all.push_back(effect);
  }
  return all;
}

py::object raised_by_effect(std::string_view sentence) {
  auto& [known, raised] = last_raised();
  if (!raised || sentence.find(known) == std::string_view::npos) return py::none();
  return std::exchange(raised, py::object());
}

void bind_effects(py::module_& module) {
  py::class_<Effect, std::shared_ptr<Effect>>(module, "Effect");
  module.def("effect", &effect_of, py::arg("name"), py::arg("function"), py::kw_only(), py::arg("inputs"),
             py::arg("gains"), py::arg("shapes"), py::arg("explanation"));
}

}  // namespace ballbar::python
