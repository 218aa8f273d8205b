#include "model/held_values.hpp"

#include <fmt/format.h>

#include <optional>
#include <string_view>

#include "ballbar/error.hpp"
#include "ballbar/internal/nearest_name.hpp"
#include "terminal/option_checks.hpp"

namespace ballbar {
namespace {

constexpr std::string_view kConstant = "constant";
constexpr std::string_view kConstantParameter = "constant_um";

struct HeldValue {
  std::string effect, parameter;
  double value = 0.0;
};

// The last point is that between effect and parameter: a formula may hold others.
HeldValue held_value_of(const std::string& setting) {
  const std::size_t equals = setting.rfind('=');
  const std::size_t point = setting.rfind('.', equals == std::string::npos ? 0 : equals);
  if (equals == std::string::npos || point == std::string::npos || point == 0 || point + 1 == equals) {
    throw Error(fmt::format("--set: expected EFFECT.PARAMETER=VALUE, found {}.", in_quotes(setting)));
  }
  const std::optional<double> value = finite_number(std::string_view(setting).substr(equals + 1));
  if (!value) throw Error(fmt::format("--set: expected a number behind the sign =, found {}.", in_quotes(setting)));
  return {setting.substr(0, point), setting.substr(point + 1, equals - point - 1), *value};
}

void set(Model& model, const HeldValue& value, bool held) {
  std::vector<std::string> labels, names;
  if (model.level == Level::series) labels.emplace_back(kConstant);
  for (Term& term : model.terms) {
    labels.push_back(label_of(term));
    if (labels.back() != value.effect) continue;
    for (std::size_t k = 0; k < term.settings.size(); ++k) {
      names.emplace_back(term.effect->parameters[k].name);
      if (names.back() != value.parameter) continue;
      term.settings[k].held = held;
      term.settings[k].start = value.value;
      return;
    }
    break;
  }
  if (value.effect == kConstant && model.level == Level::series) {
    if (value.parameter == kConstantParameter) {
      if (!held) throw Error("--set: expected a parameter of an effect to be free, found the constant.");
      model.constant_um = value.value;
      return;
    }
    names.emplace_back(kConstantParameter);
  }
  if (labels.empty()) throw Error("--set: expected an effect of the model, found a model of none.");
  const bool known = !names.empty();
  const std::string& found = known ? value.parameter : value.effect;
  const std::vector<std::string>& all = known ? names : labels;
  const std::vector<std::string_view> choices(all.begin(), all.end());
  throw Error(fmt::format("--set: expected {} of the model, found {}; the nearest is {}.",
                          known ? "a parameter of " + value.effect : "an effect", in_quotes(found),
                          nearest_name(found, choices)));
}

}  // namespace

Model with_held_values(Model model, const std::vector<std::string>& settings) {
  for (const std::string& setting : settings) set(model, held_value_of(setting), true);
  return model;
}

Model with_free_values(Model model, const std::vector<std::string>& settings) {
  for (const std::string& setting : settings) set(model, held_value_of(setting), false);
  return model;
}

}  // namespace ballbar
