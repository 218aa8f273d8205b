#include <algorithm>
#include <utility>

#include "ballbar/revision/revision.hpp"
#include "diagnosis/verdict/start_values.hpp"

namespace ballbar {
namespace {

constexpr double kImprobable = 0.05;  // P below which an effect is not what is missing

bool is_asked(const Term& term) {
  return !term.effect->rules.is_base &&
         std::any_of(term.settings.begin(), term.settings.end(), [](const Setting& setting) { return !setting.held; });
}

bool is_same(const Term& term, const BoundEffect& bound) {
  return term.effect->name == bound.effect->name && term.columns == bound.columns;
}

}  // namespace

std::vector<Replacement> replacements(const Model& model, std::span<const std::size_t> terms, const Series& data,
                                      std::size_t target, const DiagnosisOptions& options) {
  std::vector<Replacement> result;
  for (const std::size_t t : terms) {
    const Term& term = model.terms[t];
    if (!is_asked(term)) continue;
    DiagnosisOptions how = options;
    how.fit_candidates = how.leave_out = false;
    Replacement one{t, label_of(term), 0.0, diagnose(model_without(model, t), data, target, how)};
    for (const EffectProbability& effect : one.without.effects) {
      if (is_same(term, effect.bound)) one.p = effect.p;
    }
    if (one.without.named.empty() || one.p >= kImprobable) continue;
    result.push_back(std::move(one));
  }
  return result;
}

}  // namespace ballbar
