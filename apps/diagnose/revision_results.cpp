#include "diagnose/revision_results.hpp"

#include "diagnose/ledger_text.hpp"

namespace ballbar {

Ledger ledger_of(const std::vector<LedgerRow>& rows, const LedgerRow* before) {
  Ledger ledger;
  for (const LedgerRow& row : rows) {
    ledger.rows.push_back({row, sentence_of(row, before)});
    before = &row;
  }
  return ledger;
}

std::vector<AddedEffect> added_effects(const EffectTest& effect_test) {
  std::vector<AddedEffect> effects;
  const std::size_t first = effect_test.model.terms.size() - effect_test.added.size();
  for (std::size_t i = 0; i < effect_test.added.size(); ++i) {
    const Candidate& tried = effect_test.added[i];
    const Term& term = effect_test.model.terms[first + i];
    std::vector<CandidateParameter> parameters = parameters_of(tried);
    if (parameters.empty()) {  // it could not be tested
      for (const FittedParameter& parameter : effect_test.fit_after.parameters) {
        if (parameter.effect == tried.label) parameters.push_back({parameter, {}});
      }
    }
    effects.push_back({{term.effect.get(), term.columns}, tried, std::move(parameters)});
  }
  return effects;
}

}  // namespace ballbar
