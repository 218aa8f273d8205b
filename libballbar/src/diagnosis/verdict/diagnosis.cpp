#include "ballbar/diagnosis/verdict/diagnosis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "diagnosis/search/competing_subsets.hpp"
#include "diagnosis/search/null_model.hpp"
#include "diagnosis/signatures/prospects.hpp"
#include "diagnosis/verdict/candidates.hpp"
#include "diagnosis/verdict/verdict.hpp"
#include "series/subsampled.hpp"

namespace ballbar {
namespace {

// Nothing is said of effects that are not searched.
std::vector<Prospect> prospects_but(const SearchOptions& options, std::vector<Prospect> prospects) {
  const auto left_out = [&](const std::string& name) {
    return std::find(options.without.begin(), options.without.end(), name) != options.without.end();
  };
  std::erase_if(prospects, [&](const Prospect& one) { return left_out(one.effect->name); });
  for (Prospect& prospect : prospects) {
    std::erase_if(prospect.imitated_by, [&](const Likeness& likeness) { return left_out(likeness.with); });
  }
  return prospects;
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
  const Series rows = thinned(data, model.targets.at(target), options.most_rows);
  Diagnosis result;
  result.base = fit(model, rows, target);
  result.target = result.base.target;
  const Hypotheses now(model, rows, target, result.base, options.search);
  std::set<const Effect*> searched;
  for (const Family& family : now.bank().families) searched.insert(family.bound.effect);
  result.searched_effects = searched.size();
  const auto prospects_by = [&](const Projected& seen) {
    return prospects_but(options.search,
                         prospects_of(options.search.catalogue, now.bank(), seen, model, rows, options.search.motion));
  };
  if (now.bank().families.empty() || now.largest_set() == 0) {
    result.verdict = Verdict::untestable;
    result.prospects = prospects_by(now.projected_by(result.base.noise));
    result.reasons.emplace_back(now.bank().families.empty() ? "No effect of the catalogue can be tested on these data."
                                                            : "There are too few values to test anything more.");
    return result;
  }
  now.tell(fmt::format("searching {} shapes of {} effects", now.bank().signatures.size(), searched.size()));
  const Ground ground = ground_of(now, result.base.noise, options.search);
  result.prospects = prospects_by(ground.seen);
  const Detected detection = detected(now, ground);
  result.p_anything = detection.p_anything;
  result.smallest_um = detection.smallest_um;
  result.smallest = detection.smallest;
  const std::vector<SubsetFit> refits = rival_sets(now, ground);
  Judgement judgement = judged(now, rows, result.base, ground, detection.p_anything, refits, options);
  result.smooth_evidence = judgement.smooth_evidence;
  if (!refits.empty()) result.rmse_after_um = rmse_after_um(now, refits.front());
  for (const Candidate& candidate : judgement.candidates) {
    if (candidate.best_fake_fall > result.best_fake_fall) result.best_fake_fall = candidate.best_fake_fall;
  }
  result.candidates = std::move(judgement.candidates);
  result.verdict = judgement.finding.verdict;
  result.named = std::move(judgement.finding.named);
  result.equivalent = std::move(judgement.finding.equivalent);
  result.goes_with = std::move(judgement.finding.goes_with);
  result.reasons = std::move(judgement.finding.reasons);
  return result;
}

}  // namespace ballbar
