#include "diagnosis/posterior/priors.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "diagnosis/signatures/any_form.hpp"

namespace ballbar {
namespace {

// Columns alike, the effects of one column alike; all effects of several columns together `pairs`; a column in a form
// that no effect has `forms`; a jump as one more column.
std::vector<double> log_priors_of_columns(const SignatureLibrary& library, const Tuning& tuning) {
  std::map<std::string, double> effects;  // of each column alone; "" of no column
  double pairs = 0.0, forms = 0.0;
  const auto is_form = [](const Family& family) { return family.bound.effect == &any_form(); };
  for (const Family& family : library.families) {
    const std::vector<std::string>& columns = family.bound.columns;
    if (is_form(family)) {
      forms += 1.0;
    } else if (columns.size() > 1) {
      pairs += 1.0;
    } else {
      effects[columns.empty() ? "" : columns.front()] += 1.0;
    }
  }
  const double of_form = forms > 0.0 ? tuning.forms : 0.0;
  const double of_pairs = pairs == 0.0 ? 0.0 : effects.empty() ? 1.0 : tuning.pairs;
  const double of_column = (1.0 - of_pairs) / static_cast<double>(std::max<std::size_t>(1, effects.size()));
  const auto prior_of = [&](const Family& family) {
    const std::vector<std::string>& columns = family.bound.columns;
    if (is_form(family)) return of_form / forms;
    if (columns.size() > 1) return (1.0 - of_form) * of_pairs / pairs;
    return (1.0 - of_form) * of_column / effects.at(columns.empty() ? "" : columns.front());
  };
  std::vector<double> result;
  result.reserve(library.families.size());
  for (const Family& family : library.families) result.push_back(std::log(prior_of(family)));
  return result;
}

// Of recordings: effects alike, columns of an effect alike.
std::vector<double> log_priors_of_effects(const SignatureLibrary& library) {
  std::map<const Effect*, double> families;
  for (const Family& family : library.families) families[family.bound.effect] += 1.0;
  std::vector<double> result;
  result.reserve(library.families.size());
  for (const Family& family : library.families) {
    result.push_back(-std::log(static_cast<double>(families.size())) - std::log(families[family.bound.effect]));
  }
  return result;
}

// Whether a time constant of the shape is 0 although the effect can have a lag.
bool acts_at_once(const Effect& effect, const std::vector<double>& point) {
  for (std::size_t k = 0; k < effect.parameters.size(); ++k) {
    const Parameter& parameter = effect.parameters[k];
    const bool may_lag = parameter.kind == ParameterKind::shape && parameter.unit == "s" && parameter.grid.size() > 1;
    if (may_lag && parameter.grid.front() == 0.0 && point[k] == 0.0) return true;
  }
  return false;
}

bool is_time(const Parameter& parameter) { return parameter.kind == ParameterKind::shape && parameter.unit == "s"; }

}  // namespace

std::vector<double> log_priors_of_identities(const SignatureLibrary& library, Level level, const Tuning& tuning) {
  return level == Level::series ? log_priors_of_columns(library, tuning) : log_priors_of_effects(library);
}

bool is_without_its_lag(const SignatureLibrary& library, const LoggedInputs& logged, const BoundEffect& bound,
                        const std::vector<double>& point, const Tuning& tuning) {
  const bool is_shift = !bound.effect->inputs.empty() && bound.effect->inputs.front().of_another_effect;
  const bool is_twin =
      is_shift || std::any_of(library.families.begin(), library.families.end(), [&](const Family& other) {
        const Effect& effect = *other.bound.effect;
        return effect.name == bound.effect->rules.becomes && other.bound.columns == bound.columns &&
               std::none_of(effect.parameters.begin(), effect.parameters.end(), is_time);
      });
  if (!is_twin) return false;
  double late_s = 0.0;
  for (const LoggedInput& input : logged.inputs) {
    if (std::find(bound.columns.begin(), bound.columns.end(), input.column) != bound.columns.end())
      late_s = std::max(late_s, input.late_s);
  }
  for (std::size_t k = 0; k < point.size(); ++k) {
    if (is_time(bound.effect->parameters[k]) && std::abs(point[k]) < tuning.shortest_lag * late_s) return true;
  }
  return false;
}

std::vector<double> log_priors_of_shapes(const SignatureLibrary& library, const LoggedInputs& logged,
                                         const Tuning& tuning) {
  std::vector<double> result(library.signatures.size(), kLogZero);
  for (const Family& family : library.families) {
    std::vector<std::size_t> at_once, others;
    for (std::size_t i = family.first; i < family.first + family.count; ++i) {
      const std::vector<double>& point = library.signatures[i].point;
      if (is_without_its_lag(library, logged, family.bound, point, tuning)) continue;
      const bool is_at_once = tuning.at_once > 0.0 && acts_at_once(*family.bound.effect, point);
      (is_at_once ? at_once : others).push_back(i);
    }
    for (std::size_t i = family.first; i < family.first + family.count && at_once.empty() && others.empty(); ++i)
      result[i] = -std::log(static_cast<double>(family.count));
    const double share = others.empty() ? 1.0 : at_once.empty() ? 0.0 : tuning.at_once;
    for (const std::size_t i : at_once) result[i] = std::log(share / static_cast<double>(at_once.size()));
    for (const std::size_t i : others) result[i] = std::log((1.0 - share) / static_cast<double>(others.size()));
  }
  return result;
}

}  // namespace ballbar
