#include "diagnosis/next_test/truths.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "ballbar/internal/numerics/order_statistic.hpp"
#include "ballbar/series/series.hpp"
#include "diagnosis/next_test/planned_inputs.hpp"
#include "diagnosis/posterior/set_regression.hpp"
#include "model/model_rows.hpp"
#include "numerics/random_streams.hpp"

namespace ballbar {
namespace {

// An Ornstein-Uhlenbeck process on rows of equal steps.
void add_memory(double sigma, double time_constant_s, const std::vector<double>& time_s, std::mt19937_64& random,
                std::vector<double>& values) {
  if (!(sigma > 0.0) || !(time_constant_s > 0.0)) return;
  simulation::Ar1 memory(sigma, std::exp(-median_step_s(time_s) / time_constant_s));
  for (double& value : values) value += memory.next(random);
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

}  // namespace

const PossibleSet& PossibleSets::at(std::size_t set) {
  const auto [known, is_new] = fitted_.try_emplace(set);
  PossibleSet& result = known->second;
  if (!is_new) return result;
  const Posterior& posterior = inference_.posterior;
  const EffectSet& one = posterior.sets[set];
  result.problem = inference_.problem.get();
  for (const std::size_t f : one.families) result.effects.push_back(result.problem->library.families[f].bound);
  result.has_other_value = one.freed.has_value();
  result.fitted = fitted_set(*result.problem, posterior, one, false);
  result.noise = result.slow = posterior.filters[one.filter].covariance;
  result.variance = set_regression(*result.problem, posterior, one).solution.variance;
  for (const NoiseFilter& filter : posterior.filters) {
    if (!(result.slow.slow > 0.0) && filter.covariance.slow > 0.0) result.slow = filter.covariance;
  }
  return result;
}

std::vector<Truth> PossibleSets::drawn(std::size_t count, std::mt19937_64 random) {
  const Posterior& posterior = inference_.posterior;
  struct WeightedTruth {
    std::size_t set = 0;
    bool slow = false;
    double weight = 0.0;
  };
  std::vector<WeightedTruth> all;
  double sum = 0.0;
  for (std::size_t s = 0; s < posterior.sets.size(); ++s) {
    const double slow = posterior.p(posterior.sets[s]) * posterior.discrepancy;
    const auto add = [&](bool is_slow, double weight) {
      if (!(weight > 1e-6)) return;
      all.push_back({s, is_slow, weight});
      sum += weight;
    };
    add(true, slow);
    add(false, posterior.p(posterior.sets[s]) - slow);
  }
  std::vector<Truth> truths;
  if (all.empty()) return truths;
  // One uniform number, then every count-th part of the whole: each truth as often as its weight says, but for one.
  const double first = simulation::uniform(random);
  double before = 0.0;
  std::size_t next = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const double at_weight = (static_cast<double>(k) + first) / static_cast<double>(count) * sum;
    while (next + 1 < all.size() && before + all[next].weight < at_weight) before += all[next++].weight;
    truths.push_back({&at(all[next].set), all[next].slow});
  }
  // Shuffled, so that the first few are representative.
  for (std::size_t k = truths.size(); k > 1; --k) {
    std::swap(truths[k - 1], truths[static_cast<std::size_t>(simulation::uniform(random) * static_cast<double>(k))]);
  }
  return truths;
}

bool is_nothing(const Truth& truth) { return !truth.slow && !truth.set->has_other_value && truth.set->effects.empty(); }

// The run stands behind the first rows of the data, as the reference for thresholds of temperature.
Eigen::MatrixXd terms_um(const PossibleSet& set, const Series& run, Eigen::MatrixXd* slopes) {
  const Series placed = with_run(rows_of(set.problem->logged.series, {0, 2}), run);
  std::vector<std::size_t> rows(run.time_s.size());
  std::iota(rows.begin(), rows.end(), placed.time_s.size() - rows.size());
  const ModelRows all(set.fitted.model, placed, rows);
  Eigen::VectorXd parameters(all.parameters());
  std::transform(set.fitted.parameters.begin(), set.fitted.parameters.end(), parameters.begin(),
                 [](const FittedParameter& one) { return one.value; });
  Eigen::MatrixXd terms(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(all.terms()));
  for (std::size_t t = 0; t < all.terms(); ++t)
    terms.col(static_cast<Eigen::Index>(t)) = all.term(t, parameters.data() + all.offset(t), nullptr);
  if (slopes != nullptr) all.sum(parameters, slopes);
  return terms;
}

Eigen::VectorXd drift_um(const PossibleSet& set, const Series& run) {
  const Eigen::MatrixXd terms = terms_um(set, run);
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(terms.rows());
  for (Eigen::Index t = 0; t < terms.cols(); ++t) {
    if (!set.fitted.model.terms[static_cast<std::size_t>(t)].effect->rules.of_set_up) sum += terms.col(t);
  }
  return sum;
}

std::vector<double> readings_um(const Truth& truth, const Series& run, double resolution_um, std::mt19937_64& random) {
  const Eigen::VectorXd drift = drift_um(*truth.set, run);
  std::vector<double> values(drift.begin(), drift.end());
  const Covariance& noise = truth.slow ? truth.set->slow : truth.set->noise;
  const double sigma = std::sqrt(truth.set->variance);
  for (double& value : values) value += sigma * std::sqrt(noise.white) * simulation::normal(random);
  add_memory(sigma * std::sqrt(noise.correlated), noise.time_s, run.time_s, random, values);
  if (truth.slow) {
    const auto add_discrepancy = noise.slow_is_rough ? add_memory : add_slow;
    add_discrepancy(sigma * std::sqrt(noise.slow), noise.slow_time_s, run.time_s, random, values);
  }
  for (double& value : values) value = simulation::rounded(value, resolution_um);
  return values;
}

}  // namespace ballbar
