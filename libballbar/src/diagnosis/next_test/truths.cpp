#include "diagnosis/next_test/truths.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "diagnosis/posterior/set_regression.hpp"
#include "model/model_rows.hpp"
#include "numerics/random_streams.hpp"

namespace ballbar {
namespace {

double weight_of(const Posterior& posterior, double log_weight) { return std::exp(log_weight - posterior.log_total); }

// An Ornstein-Uhlenbeck process on the rows.
void add_memory(double sigma, double time_constant_s, const std::vector<double>& time_s, std::mt19937_64& random,
                std::vector<double>& values) {
  if (!(sigma > 0.0) || !(time_constant_s > 0.0)) return;
  double state = sigma * simulation::normal(random);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i > 0) {
      const double kept = std::exp(-(time_s[i] - time_s[i - 1]) / time_constant_s);
      state = kept * state + sigma * std::sqrt(1.0 - kept * kept) * simulation::normal(random);
    }
    values[i] += state;
  }
}

// Matern 3/2 of this standard deviation: its level and slope from row to row, in steps short beside its length.
void add_slow(double sigma, double time_constant_s, const std::vector<double>& time_s, std::mt19937_64& random,
              std::vector<double>& values) {
  if (!(sigma > 0.0) || !(time_constant_s > 0.0)) return;
  const double lambda = std::sqrt(3.0) / time_constant_s, density = 4.0 * lambda * lambda * lambda * sigma * sigma;
  double level = sigma * simulation::normal(random), slope = lambda * sigma * simulation::normal(random);
  for (std::size_t i = 0; i < values.size(); ++i) {
    double left_s = i > 0 ? time_s[i] - time_s[i - 1] : 0.0;
    while (left_s > 0.0) {
      const double step_s = std::min(left_s, 0.05 / lambda);
      const double pull = -lambda * lambda * level - 2.0 * lambda * slope;
      level += step_s * slope;
      slope += step_s * pull + std::sqrt(density * step_s) * simulation::normal(random);
      left_s -= step_s;
    }
    values[i] += level;
  }
}

std::vector<std::size_t> rows_behind(const Series& placed, const Series& run) {
  std::vector<std::size_t> rows(run.time_s.size());
  std::iota(rows.begin(), rows.end(), placed.time_s.size() - run.time_s.size());
  return rows;
}

}  // namespace

// The run with the first row of the data in front, as the reference for thresholds of temperature.
Series Truths::behind_the_data(const Series& run) const {
  const Series& data = inference_.problem->logged.series;
  Series placed = run;
  placed.time_s.insert(placed.time_s.begin(), {run.time_s.front(), run.time_s.front() + 1.0});
  for (Column& column : placed.columns) {
    const Column* known = find_column(data, column.name);
    const double first = known != nullptr ? known->values.front() : column.values.front();
    column.values.insert(column.values.begin(), 2, first);
  }
  return placed;
}

Truths::Truths(const Inference& inference) : inference_(inference) {}

const Truths::Fitted& Truths::fitted(std::size_t set) const {
  const auto known = fitted_.find(set);
  if (known != fitted_.end()) return known->second;
  const Posterior& posterior = inference_.posterior;
  const EffectSet& one = posterior.sets[set];
  Fitted result;
  result.set = fitted_set(*inference_.problem, posterior, one, false);
  result.noise = result.slow = posterior.points[one.point].covariance;
  result.variance = set_regression(*inference_.problem, posterior, one).variance;
  for (const Point& point : posterior.points) {
    if (!(result.slow.slow > 0.0) && point.covariance.slow > 0.0) result.slow = point.covariance;
  }
  return fitted_.emplace(set, std::move(result)).first->second;
}

std::vector<Truth> Truths::drawn(std::size_t count, std::mt19937_64& random) const {
  const Posterior& posterior = inference_.posterior;
  struct WeightedTruth {
    Truth truth;
    double weight;
  };
  std::vector<WeightedTruth> all;
  double sum = 0.0;
  for (std::size_t s = 0; s < posterior.sets.size(); ++s) {
    const EffectSet& set = posterior.sets[s];
    const double slow = weight_of(posterior, set.log_weight_slow), whole = weight_of(posterior, set.log_weight);
    const auto add = [&](bool is_slow, double weight) {
      if (!(weight > 1e-6)) return;
      all.push_back({{s, is_slow}, weight});
      sum += weight;
    };
    add(true, slow);
    add(false, whole - slow);
  }
  std::vector<Truth> truths;
  if (all.empty()) return truths;
  // One uniform number, then every count-th part of the whole: each truth as often as its weight says, but for one.
  const double first = simulation::uniform(random);
  double before = 0.0;
  std::size_t next = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const double at = (static_cast<double>(k) + first) / static_cast<double>(count) * sum;
    while (next + 1 < all.size() && before + all[next].weight < at) before += all[next++].weight;
    truths.push_back(all[next].truth);
  }
  for (const Truth& truth : truths) fitted(truth.set);
  // Shuffled, so that the first few are representative.
  for (std::size_t k = truths.size(); k > 1; --k) {
    std::swap(truths[k - 1], truths[static_cast<std::size_t>(simulation::uniform(random) * static_cast<double>(k))]);
  }
  return truths;
}

std::vector<BoundEffect> Truths::effects_of(const Truth& truth) const {
  std::vector<BoundEffect> effects;
  for (const std::size_t f : inference_.posterior.sets[truth.set].families) {
    effects.push_back(inference_.problem->library.families[f].bound);
  }
  return effects;
}

bool Truths::is_nothing(const Truth& truth) const {
  return !truth.slow && !has_other_value(truth) && inference_.posterior.sets[truth.set].families.empty();
}

Eigen::VectorXd Truths::drift_um(const Truth& truth, const Series& run) const {
  const Model& model = fitted(truth.set).set.model;
  return added_um(truth, run, [&](std::size_t t) { return !model.terms[t].effect->rules.of_set_up; });
}

Eigen::VectorXd Truths::member_um(const Truth& truth, std::size_t member, const Series& run) const {
  const std::size_t first = inference_.problem->model.terms.size();
  return added_um(truth, run, [&](std::size_t t) { return t == first + member; });
}

Eigen::MatrixXd Truths::model_slopes(const Truth& truth, const Series& run) const {
  const FittedSet& set = fitted(truth.set).set;
  const Model& model = inference_.problem->model;
  const std::size_t count = inference_.problem->base_model->parameters();
  Eigen::VectorXd parameters(static_cast<Eigen::Index>(count));
  for (std::size_t k = 0; k < count; ++k) parameters[static_cast<Eigen::Index>(k)] = set.parameters[k].value;
  const Series placed = behind_the_data(run);
  Eigen::MatrixXd slopes;
  ModelRows(model, placed, rows_behind(placed, run)).sum(parameters, &slopes);
  for (std::size_t k = 1; k < count; ++k) {
    if (set.parameters[k].state == ParameterState::held) slopes.col(static_cast<Eigen::Index>(k)).setZero();
  }
  return slopes;
}

// The sum of some terms of the model with the set.
Eigen::VectorXd Truths::added_um(const Truth& truth, const Series& run,
                                 const std::function<bool(std::size_t)>& is_included) const {
  const FittedSet& set = fitted(truth.set).set;
  const Series placed = behind_the_data(run);
  const std::vector<std::size_t> rows = rows_behind(placed, run);
  const ModelRows all(set.model, placed, rows);
  std::vector<double> parameters;
  parameters.reserve(set.parameters.size());
  for (const FittedParameter& one : set.parameters) parameters.push_back(one.value);
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(rows.size()));
  std::size_t place = 1;
  for (std::size_t t = 0; t < set.model.terms.size(); ++t) {
    if (is_included(t)) sum += all.term(t, parameters.data() + place, nullptr);
    place += set.model.terms[t].settings.size();
  }
  return sum;
}

std::vector<double> Truths::readings_um(const Truth& truth, const Series& run, double resolution_um,
                                        std::mt19937_64& random) const {
  const Fitted& of = fitted(truth.set);
  const Eigen::VectorXd drift = drift_um(truth, run);
  std::vector<double> values(drift.begin(), drift.end());
  const Covariance& noise = truth.slow ? of.slow : of.noise;
  const double sigma = std::sqrt(of.variance);
  for (double& value : values) value += sigma * std::sqrt(noise.white) * simulation::normal(random);
  add_memory(sigma * std::sqrt(noise.correlated), noise.time_s, run.time_s, random, values);
  if (truth.slow) add_slow(sigma * std::sqrt(noise.slow), noise.slow_time_s, run.time_s, random, values);
  if (resolution_um > 0.0) {
    for (double& value : values) value = resolution_um * std::round(value / resolution_um);
  }
  return values;
}

double Truths::sigma_um(const Truth& truth) const {
  const Fitted& of = fitted(truth.set);
  return std::sqrt(of.variance * (of.noise.white + of.noise.correlated));
}

}  // namespace ballbar
