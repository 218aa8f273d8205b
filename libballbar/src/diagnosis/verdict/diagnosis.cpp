#include "ballbar/diagnosis/verdict/diagnosis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "diagnosis/search/competing_subsets.hpp"
#include "diagnosis/search/null_model.hpp"
#include "diagnosis/signatures/detectability.hpp"
#include "diagnosis/verdict/candidates.hpp"
#include "diagnosis/verdict/verdict.hpp"
#include "series/subsampled.hpp"

namespace ballbar {
namespace {

// Nothing is said of effects that are not searched.
std::vector<Detectability> detectability_but(const SearchOptions& options, std::vector<Detectability> detectability) {
  const auto left_out = [&](const std::string& name) {
    return std::find(options.without.begin(), options.without.end(), name) != options.without.end();
  };
  std::erase_if(detectability, [&](const Detectability& one) { return left_out(one.effect->name); });
  for (Detectability& detectable : detectability) {
    std::erase_if(detectable.imitated_by, [&](const Likeness& likeness) { return left_out(likeness.with); });
  }
  return detectability;
}

}  // namespace

std::string_view name_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::named:
      return "named";
    case Verdict::equivalent:
      return "equivalent";
    case Verdict::unexplained:
      return "unexplained";
    case Verdict::untestable:
      return "untestable";
    case Verdict::nothing:
      return "nothing";
  }
  return "nothing";
}

Diagnosis diagnose(const Model& model, const Series& data, std::size_t target, const DiagnosisOptions& options) {
  const Series rows = subsampled(data, model.targets.at(target), options.most_rows);
  Diagnosis result;
  result.base = fit(model, rows, target);
  result.target = result.base.target;
  const SubsetFits now(model, rows, target, result.base, options.search);
  std::set<const Effect*> searched;
  for (const Family& family : now.signatures().families) searched.insert(family.bound.effect);
  result.searched_effects = searched.size();
  const auto detectability_by = [&](const Projected& seen) {
    return detectability_but(options.search, detectability_of(options.search.catalogue, now.signatures(), seen, model,
                                                              rows, options.search.motion));
  };
  if (now.signatures().families.empty() || now.largest_set() == 0) {
    result.verdict = Verdict::untestable;
    result.detectability = detectability_by(now.projected_by(result.base.noise));
    result.reasons.emplace_back(now.signatures().families.empty()
                                    ? "No effect of the catalogue can be tested on these data."
                                    : "There are too few values to test anything more.");
    return result;
  }
  now.tell(fmt::format("searching {} shapes of {} effects", now.signatures().signatures.size(), searched.size()));
  const NullModel null_model = null_model_of(now, result.base.noise, options.search);
  result.detectability = detectability_by(null_model.seen);
  const Detected detection = detected(now, null_model);
  result.p_anything = detection.p_anything;
  result.smallest_um = detection.smallest_um;
  result.smallest = detection.smallest;
  const std::vector<SubsetFit> refits = competing_subsets(now, null_model);
  Findings findings = findings_of(now, rows, result.base, null_model, detection.p_anything, refits, options);
  result.smooth_likelihood_ratio = findings.smooth_likelihood_ratio;
  if (!refits.empty()) result.rmse_after_um = rmse_after_um(now, refits.front());
  for (const Candidate& candidate : findings.candidates) {
    if (candidate.best_surrogate_fall > result.best_surrogate_fall)
      result.best_surrogate_fall = candidate.best_surrogate_fall;
  }
  result.candidates = std::move(findings.candidates);
  result.verdict = findings.finding.verdict;
  result.named = std::move(findings.finding.named);
  result.equivalent = std::move(findings.finding.equivalent);
  result.associations = std::move(findings.finding.associations);
  result.reasons = std::move(findings.finding.reasons);
  return result;
}

}  // namespace ballbar
