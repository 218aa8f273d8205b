#include "effect_regression/predictors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "ballbar/effect_regression/effect_regression.hpp"
#include "ballbar/error.hpp"
#include "ballbar/model/model.hpp"
#include "effects/temperature_at_start.hpp"
#include "model/bindings.hpp"

namespace ballbar {
namespace {

bool takes_part(const Effect& effect) { return effect.level == Level::series && effect.rules.predictor; }

// nullptr: none of that name takes part.
std::shared_ptr<const Effect> predictor_effect(const std::string& name, const Catalogue& catalogue) {
  const auto found = std::find_if(catalogue.begin(), catalogue.end(),
                                  [&](const auto& effect) { return effect->name == name && takes_part(*effect); });
  return found == catalogue.end() ? nullptr : *found;
}

// Columns that in some run have a gap, and those that stand still in all.
std::vector<std::string> unusable(std::span<const Series> runs) {
  std::vector<std::string> names;
  for (const Column& first : runs.front().columns) {
    if (first.role == Role::measured || first.values.empty()) continue;
    bool whole = true, moves = false;
    double value = first.values.front();
    for (const Series& run : runs) {
      const Column* column = find_column(run, first.name);
      if (column == nullptr) {
        throw Error(fmt::format("expected {} in every run, found one without.", first.name));
      }
      for (const double next : column->values) {
        whole = whole && std::isfinite(next);
        moves = moves || next != value;
      }
    }
    if (!whole || !moves) names.push_back(first.name);
  }
  return names;
}

// Every combination of the grid's values at its shapes; the first gain 1, others 0.
std::vector<std::vector<double>> points_of(const Effect& effect) {
  std::vector<double> point;
  bool first = true;
  for (const Parameter& parameter : effect.parameters) {
    const bool is_gain = parameter.kind == ParameterKind::gain;
    point.push_back(is_gain && first ? 1.0 : is_gain ? 0.0 : parameter.start);
    first = first && !is_gain;
  }
  std::vector<std::vector<double>> points{point};
  std::size_t shape = 0;
  for (std::size_t k = 0; k < effect.parameters.size(); ++k) {
    if (effect.parameters[k].kind == ParameterKind::gain) continue;
    std::vector<std::vector<double>> more;
    for (const std::vector<double>& at : points) {
      for (const double value : effect.rules.predictor->grid[shape]) {
        more.push_back(at);
        more.back()[k] = value;
      }
    }
    points = std::move(more);
    ++shape;
  }
  return points;
}

class Collected {
 public:
  explicit Collected(Predictors& into) : into_(into) {}

  std::size_t index_of(const std::shared_ptr<const Effect>& effect, const std::vector<std::string>& columns,
                       const std::vector<double>& parameters) {
    const auto [place, is_new] = known_.try_emplace({effect->name, columns, parameters}, into_.each.size());
    if (is_new) into_.each.push_back({effect, columns, parameters});
    return place->second;
  }

  void add(const std::shared_ptr<const Effect>& effect, const Catalogue& catalogue,
           const std::vector<std::vector<std::string>>& bindings) {
    const PredictorRule& rule = *effect->rules.predictor;
    PredictorFamily family{rule.kind, {}};
    const std::shared_ptr<const Effect> other =
        rule.difference_of.empty() ? nullptr : predictor_effect(rule.difference_of, catalogue);
    for (const std::vector<double>& point : points_of(*effect)) {
      for (const std::vector<std::string>& binding : bindings) {
        if (other == nullptr) {
          family.members.push_back({index_of(effect, binding, point)});
        } else {
          const std::size_t plus = index_of(other, {binding[0]}, point);
          family.members.push_back({plus, index_of(other, {binding[1]}, point)});
        }
      }
    }
    if (!family.members.empty()) into_.families.push_back(std::move(family));
  }

 private:
  Predictors& into_;
  std::map<std::tuple<std::string, std::vector<std::string>, std::vector<double>>, std::size_t> known_;
};

}  // namespace

std::vector<double> with_gain(const Predictor& predictor, double gain) {
  std::vector<double> parameters = predictor.parameters;
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    if (predictor.effect->parameters[k].kind == ParameterKind::gain) parameters[k] *= gain;
  }
  return parameters;
}

Catalogue predictor_effects(const Catalogue& catalogue) {
  Catalogue effects;
  for (const std::shared_ptr<const Effect>& effect : catalogue) {
    if (takes_part(*effect)) effects.push_back(effect);
  }
  effects.push_back(temperature_at_start());
  return effects;
}

Predictors predictors_of(std::span<const Series> runs, const std::string& target, const Catalogue& catalogue) {
  Model model;
  model.targets = {target};
  model.not_inputs = unusable(runs);
  Predictors predictors;
  predictors.left_out = model.not_inputs;
  Collected collected(predictors);
  const Series& first = runs.front();
  for (const std::shared_ptr<const Effect>& effect : catalogue) {
    if (!takes_part(*effect)) continue;
    collected.add(effect, catalogue, bindings_of(*effect, model, first));
  }
  if (runs.size() > 1)
    collected.add(temperature_at_start(), catalogue, bindings_of(*temperature_at_start(), model, first));
  if (!predictors.each.empty()) return predictors;
  throw Error("expected a column of a temperature, a speed or a load that moves, found none.");
}

}  // namespace ballbar
