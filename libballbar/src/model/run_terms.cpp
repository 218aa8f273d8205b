#include "ballbar/internal/model/run_terms.hpp"

#include <algorithm>
#include <vector>

#include "ballbar/series/series.hpp"
#include "effects/run_effects.hpp"

namespace ballbar {
namespace {

Term of_run(const std::shared_ptr<const Effect>& effect, std::size_t run) {
  Term term = term_of(*effect, {});
  term.effect = effect;
  for (std::size_t k = 0; k < term.settings.size(); ++k) {
    if (effect->parameters[k].shape_of != ShapeOf::recording) continue;
    term.settings[k].start = static_cast<double>(run);
    term.settings[k].held = true;
  }
  return term;
}

}  // namespace

Model with_run_terms(Model model, const Series& data) {
  if (model.level != Level::series) return model;
  const std::size_t count = runs_of(data.time_s).size();
  if (count < 2) return model;
  std::vector<Term> terms;
  for (std::size_t run = 0; run < count; ++run) {
    if (run > 0) terms.push_back(of_run(offset_of_run(), run));
    const bool is_warm = run < data.runs.size() && data.runs[run].start == RunStart::warm;
    if (is_warm) terms.push_back(of_run(start_of_run(), run));
  }
  model.terms.insert(model.terms.begin(), terms.begin(), terms.end());
  return model;
}

Model without_run_terms(Model model) {
  std::erase_if(model.terms, [](const Term& term) { return term.effect->rules.of_set_up; });
  return model;
}

}  // namespace ballbar
