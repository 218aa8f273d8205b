#include "predict/design.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <string>
#include <tuple>

#include "ballbar/error.hpp"
#include "ballbar/fit/fit.hpp"
#include "ballbar/internal/fit/held_model.hpp"
#include "ballbar/internal/numerics/parallel.hpp"
#include "ballbar/model/model.hpp"
#include "ballbar/predict/train.hpp"
#include "effects/run_effects.hpp"
#include "model/bindings.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kFewestValues = 40;

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
  std::vector<std::vector<double>> points{{}};
  std::size_t shape = 0;
  bool first = true;
  for (const Parameter& parameter : effect.parameters) {
    const bool is_gain = parameter.kind == ParameterKind::gain;
    const std::vector<double> values = is_gain ? std::vector{first ? 1.0 : 0.0} : effect.rules.predictor->grid[shape++];
    first = first && !is_gain;
    std::vector<std::vector<double>> longer;
    for (const std::vector<double>& point : points) {
      for (const double value : values) {
        longer.push_back(point);
        longer.back().push_back(value);
      }
    }
    points = std::move(longer);
  }
  return points;
}

// What a unit of the predictor adds, at the rows of the design.
void evaluate(const Predictor& predictor, std::span<const Series> runs, Design& design, Eigen::Index column) {
  std::vector<double> out;
  std::size_t begin = 0;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    EffectRows all{runs[r].time_s, {}};
    for (const std::string& name : predictor.columns) all.inputs.emplace_back(find_column(runs[r], name)->values);
    out.resize(runs[r].time_s.size());
    predictor.effect->evaluate(all, predictor.parameters.data(), out.data(), nullptr);
    for (; begin < design.run.size() && design.run[begin] == r; ++begin)
      design.values(static_cast<Eigen::Index>(begin), column) = out[design.row[begin]];
  }
}

// A unit of a fitted term's gain.
Predictor unit_of(const Term& fitted) {
  Predictor predictor{fitted.effect, fitted.columns, {}};
  for (std::size_t k = 0; k < fitted.settings.size(); ++k) {
    const bool is_gain = fitted.effect->parameters[k].kind == ParameterKind::gain;
    predictor.parameters.push_back(is_gain ? 1.0 : fitted.settings[k].start);
  }
  return predictor;
}

// Of the dictionary, or with one gain and a column.
bool may_predict(const Effect& effect) {
  const auto gains = std::count_if(effect.parameters.begin(), effect.parameters.end(),
                                   [](const Parameter& one) { return one.kind == ParameterKind::gain; });
  return effect.level == Level::series && (effect.rules.predictor || (!effect.inputs.empty() && gains == 1));
}

class PredictorIndex {
 public:
  explicit PredictorIndex(Predictors& into) : into_(into) {}

  std::size_t index_of(const std::shared_ptr<const Effect>& effect, const std::vector<std::string>& columns,
                       const std::vector<double>& parameters) {
    const auto [place, is_new] = known_.try_emplace({effect->name, columns, parameters}, into_.each.size());
    if (is_new) into_.each.push_back({effect, columns, parameters});
    return place->second;
  }

  void add(const std::shared_ptr<const Effect>& effect, const Catalogue& effects,
           const std::vector<std::vector<std::string>>& bindings) {
    const PredictorRule& rule = *effect->rules.predictor;
    PredictorFamily family{rule.kind, {}};
    const auto other =
        std::find_if(effects.begin(), effects.end(), [&](const auto& one) { return one->name == rule.difference_of; });
    for (const std::vector<double>& point : points_of(*effect)) {
      for (const std::vector<std::string>& binding : bindings) {
        if (other == effects.end()) {
          family.members.push_back({index_of(effect, binding, point)});
        } else {
          const std::size_t plus = index_of(*other, {binding[0]}, point);
          family.members.push_back({plus, index_of(*other, {binding[1]}, point)});
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
    if (may_predict(*effect)) effects.push_back(effect);
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
  PredictorIndex collected(predictors);
  const Catalogue effects = predictor_effects(catalogue);
  for (const std::shared_ptr<const Effect>& effect : effects) {
    if (!effect->rules.predictor) continue;
    if (effect->rules.predictor->kind == PredictorKind::start && runs.size() == 1) continue;
    collected.add(effect, effects, bindings_of(*effect, model, runs.front()));
  }
  if (!predictors.each.empty()) return predictors;
  throw Error("expected a column of a temperature, a speed or a load that moves, found none.");
}

std::vector<std::size_t> thinned(const std::vector<std::size_t>& rows, std::size_t most) {
  const std::size_t step = (rows.size() + most - 1) / std::max<std::size_t>(1, most);
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < rows.size(); i += std::max<std::size_t>(1, step)) kept.push_back(rows[i]);
  return kept;
}

std::vector<std::size_t> rows_between(std::size_t first, std::size_t end) {
  std::vector<std::size_t> rows(end - first);
  std::iota(rows.begin(), rows.end(), first);
  return rows;
}

Design design_of(std::span<const Series> runs, const std::string& target, const Catalogue& catalogue) {
  Design design;
  design.runs = runs.size();
  std::vector<std::vector<std::size_t>> rows;  // of each run, at which the target is known
  std::size_t count = 0;
  for (const Series& run : runs) {
    expect_explainable({target}, run);
    const std::vector<double>& values = find_column(run, target)->values;
    rows.emplace_back();
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (std::isfinite(values[i])) rows.back().push_back(i);
    }
    count += rows.back().size();
  }
  if (count < kFewestValues) {
    throw Error(fmt::format("{}: expected at least {} values to train on, found {}.", target, kFewestValues, count));
  }
  const std::size_t step = (count + kMostDesignRows - 1) / kMostDesignRows;
  for (std::vector<std::size_t>& of_run : rows) of_run = thinned(of_run, (of_run.size() + step - 1) / step);
  design.predictors = predictors_of(runs, target, catalogue);
  std::vector<double> values;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const Column& measured = *find_column(runs[r], target);
    for (const std::size_t i : rows[r]) {
      design.time_s.push_back(runs[r].time_s[i]);
      design.run.push_back(r);
      design.row.push_back(i);
      values.push_back(measured.values[i]);
    }
  }
  const auto n = static_cast<Eigen::Index>(values.size());
  design.target_um = Eigen::Map<const Eigen::VectorXd>(values.data(), n);
  design.values.resize(n, static_cast<Eigen::Index>(design.predictors.each.size()));
  in_parallel(design.predictors.each.size(),
              [&](std::size_t k) { evaluate(design.predictors.each[k], runs, design, static_cast<Eigen::Index>(k)); });
  return design;
}

bool can_be_named(const Model& model) {
  return std::all_of(model.terms.begin(), model.terms.end(),
                     [](const Term& term) { return may_predict(*term.effect); });
}

Model fitted(Model model, std::span<const Series> runs) {
  for (const Term& term : model.terms) {
    if (may_predict(*term.effect)) continue;
    throw Error(fmt::format(
        "{} in the model: expected effects with one gain that read a column, for others say nothing of new rows.",
        label_of(term)));
  }
  const std::vector<FittedParameter> parameters =
      fit(model, runs.size() == 1 ? runs.front() : joined_batches(runs, model)).parameters;
  return held_at(std::move(model), parameters);
}

Design with_named(Design design, const Model& held, std::span<const Series> runs) {
  std::vector<Predictor>& each = design.predictors.each;
  each.resize(each.size() - design.predictors.named.size());
  design.predictors.named.clear();
  for (const Term& term : held.terms) {
    design.predictors.named.push_back(each.size());
    each.push_back(unit_of(term));
  }
  design.values.conservativeResize(Eigen::NoChange, static_cast<Eigen::Index>(each.size()));
  for (const std::size_t k : design.predictors.named) evaluate(each[k], runs, design, static_cast<Eigen::Index>(k));
  return design;
}

Design with_start(Design design, const EffectRegression& start, std::span<const Series> runs) {
  for (const ColumnRange& range : start.model.trained) {
    for (const Series& run : runs) {
      for (const double value : column_of(run, range.column).values) {
        if (!std::isfinite(value))
          throw Error(fmt::format("{}: expected no gaps, for the regression to start from reads it.", range.column));
      }
    }
  }
  std::vector<Predictor>& each = design.predictors.each;
  const auto m = static_cast<Eigen::Index>(start.model.terms.size());
  GainPrior prior{{}, Eigen::VectorXd(m), start.sd_um, Eigen::MatrixXd(m, m), start.sigma_um};
  for (Eigen::Index t = 0; t < m; ++t) {
    const Term& term = start.model.terms[static_cast<std::size_t>(t)];
    Predictor predictor = unit_of(term);
    for (std::size_t k = 0; k < term.settings.size(); ++k) {
      if (term.effect->parameters[k].kind == ParameterKind::gain) prior.mean[t] = term.settings[k].start;
    }
    const auto known = std::find_if(each.begin(), each.end(), [&](const Predictor& one) {
      return one.effect->name == predictor.effect->name && one.columns == predictor.columns &&
             one.parameters == predictor.parameters;
    });
    prior.at.push_back(static_cast<std::size_t>(known - each.begin()));
    if (known != each.end()) continue;
    each.push_back(std::move(predictor));
    design.values.conservativeResize(Eigen::NoChange, static_cast<Eigen::Index>(each.size()));
    evaluate(each.back(), runs, design, static_cast<Eigen::Index>(each.size()) - 1);
  }
  // Of scaled gains, without the constant and the discrepancy at the end.
  const Eigen::MatrixXd factor = start.factor_um.middleRows(1, m);
  const Eigen::VectorXd unit = start.sd_um.cwiseInverse() / start.sigma_um;
  prior.covariance = unit.asDiagonal() * (factor * factor.transpose()) * unit.asDiagonal();
  design.prior = std::move(prior);
  return design;
}

}  // namespace ballbar
