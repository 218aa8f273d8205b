#include "diagnosis/posterior/posterior.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "diagnosis/posterior/beside.hpp"

namespace ballbar {
namespace {

constexpr double kSameGainOfSignal = 2.0;  // factor: gains nearer to one another than that are one
constexpr double kSamplesLeftOpen = 2.0;   // of a logger

// A time that is no longer than what a logger leaves open.
bool is_within_a_sample(const LoggedInputs& logged, const Effect& effect, const std::vector<double>& point,
                        const std::string& column) {
  const auto input = std::find_if(logged.inputs.begin(), logged.inputs.end(),
                                  [&](const LoggedInput& one) { return one.column == column; });
  if (input == logged.inputs.end()) return false;
  for (std::size_t k = 0; k < point.size(); ++k) {
    const bool is_time = effect.parameters[k].kind == ParameterKind::shape && effect.parameters[k].unit == "s";
    if (is_time && std::abs(point[k]) <= kSamplesLeftOpen * input->sample_s) return true;
  }
  return false;
}

// Whether a term of the model that reads the column has about this gain.
bool has_gain_of(const Model& model, const std::vector<double>& parameters, const std::string& column, double gain) {
  std::size_t first = 1;  // the constant is before
  for (const Term& term : model.terms) {
    const bool reads = std::find(term.columns.begin(), term.columns.end(), column) != term.columns.end();
    for (std::size_t k = 0; k < term.settings.size() && reads; ++k) {
      if (term.effect->parameters[k].kind != ParameterKind::gain) continue;
      const double ratio = gain / parameters[first + k];
      if (ratio > 1.0 / kSameGainOfSignal && ratio < kSameGainOfSignal) return true;
    }
    first += term.settings.size();
  }
  return false;
}

// An effect on a signal of another one, which has that one's gain, with a gain far from it: something else.
bool is_inconsistent(const Problem& problem, const SetTable& table, const EffectSet& set) {
  Eigen::Index column = 0;
  for (const std::size_t i : set.signatures) {
    const Signature& one = problem.library.signatures[i];
    const BoundEffect& bound = problem.library.families[one.family].bound;
    const std::vector<Input>& inputs = bound.effect->inputs;
    const auto of_another =
        std::find_if(inputs.begin(), inputs.end(), [](const Input& input) { return input.of_another_effect; });
    if (of_another != inputs.end()) {
      const std::string& name = bound.columns[static_cast<std::size_t>(of_another - inputs.begin())];
      const Beside beside =
          parameters_beside(problem, table.variants[set.variant], set.signatures, table.points[set.point]);
      const double gain = beside.coefficients[column] / problem.deviation[one.first];
      if (!has_gain_of(problem.model, beside.parameters, name, gain) ||
          is_within_a_sample(problem.logged, *bound.effect, one.point, name))
        return true;
    }
    column += one.width;
  }
  return false;
}

EffectSet summed_set(const SetTable& table, const SetKey& key, const std::vector<FoundSet>& at) {
  EffectSet set;
  set.families = key.families;
  set.own = key.own;
  set.most = kLogZero;
  std::vector<double> any, slow;
  for (std::size_t g = 0; g < at.size(); ++g) {
    if (at[g].log_weight == kLogZero) continue;
    any.push_back(at[g].log_weight);
    if (table.points[g].covariance.slow > 0.0) slow.push_back(at[g].log_weight);
    if (at[g].most > set.most) {
      set.most = at[g].most;
      set.signatures = at[g].signatures;
      set.point = g;
      set.variant = at[g].variant;
    }
  }
  set.log_weight = log_sum(any);
  set.log_weight_slow = log_sum(slow);
  return set;
}

}  // namespace

double Posterior::p(const EffectSet& set) const { return std::exp(set.log_weight - log_total); }

Posterior summed(const Problem& problem, SetTable table) {
  Posterior result;
  std::vector<double> all;
  for (const auto& [key, at] : table.sets) {
    EffectSet set = summed_set(table, key, at);
    if (set.log_weight == kLogZero || is_inconsistent(problem, table, set)) continue;
    if (!set.families.empty() && set.families.back() >= problem.effects) {
      result.any_form.push_back(std::move(set));
      continue;
    }
    all.push_back(set.log_weight);
    result.sets.push_back(std::move(set));
  }
  std::stable_sort(result.sets.begin(), result.sets.end(),
                   [](const EffectSet& a, const EffectSet& b) { return a.log_weight > b.log_weight; });
  result.log_total = log_sum(all);
  result.points = std::move(table.points);
  result.variants = std::move(table.variants);
  return result;
}

}  // namespace ballbar
