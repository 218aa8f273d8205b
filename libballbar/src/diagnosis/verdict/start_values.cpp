#include "diagnosis/verdict/start_values.hpp"

#include <iterator>
#include <optional>
#include <utility>

#include "diagnosis/verdict/fitted_set.hpp"

namespace ballbar {
namespace {

void begin_at(Term& term, const Term& fitted) {
  for (std::size_t k = 0; k < term.settings.size(); ++k) {
    Setting& setting = term.settings[k];
    if (setting.held || setting.stated || term.effect->parameters[k].kind == ParameterKind::gain) continue;
    const double start = fitted.settings[k].start;
    if (start < setting.lower || start > setting.upper) continue;  // found within another range
    setting.start = start;
    setting.stated = true;
  }
}

}  // namespace

std::vector<BoundEffect> bounds_of(const std::vector<Term>& terms) {
  std::vector<BoundEffect> bounds;
  bounds.reserve(terms.size());
  for (const Term& term : terms) bounds.push_back({term.effect.get(), term.columns});
  return bounds;
}

const EffectSet* set_of_all(Inference& found, const std::vector<BoundEffect>& bounds) {
  std::vector<std::size_t> families;
  for (const BoundEffect& bound : bounds) {
    const std::optional<std::size_t> family = family_of(*found.problem, bound);
    if (!family) return nullptr;
    families.push_back(*family);
  }
  if (found.posterior.sets.empty()) return nullptr;
  return &found.posterior.sets[set_of(*found.problem, found.posterior, std::move(families))];
}

std::size_t member_of(const Inference& found, const EffectSet& set, const BoundEffect& bound) {
  const std::size_t family = *family_of(*found.problem, bound);
  std::size_t m = 0;
  while (found.problem->library.signatures[set.signatures[m]].family != family) ++m;
  return m;
}

std::vector<Term> with_start_values(Inference& found, std::vector<Term> terms) {
  const std::vector<BoundEffect> bounds = bounds_of(terms);
  const EffectSet* set = set_of_all(found, bounds);
  if (set == nullptr) return terms;
  const FittedSet fitted = fitted_set(*found.problem, found.posterior, *set, false);
  for (std::size_t t = 0; t < terms.size(); ++t) {
    const std::size_t m = member_of(found, *set, bounds[t]);
    begin_at(terms[t], fitted.model.terms[found.problem->model.terms.size() + m]);
  }
  return terms;
}

Model model_without(Model model, std::size_t term) {
  model.terms.erase(model.terms.begin() + static_cast<std::ptrdiff_t>(term));
  return model;
}

Model model_with(Inference& found, Model model, std::vector<Term> terms) {
  terms = with_start_values(found, std::move(terms));
  std::move(terms.begin(), terms.end(), std::back_inserter(model.terms));
  return model;
}

}  // namespace ballbar
