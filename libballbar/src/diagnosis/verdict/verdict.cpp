#include "diagnosis/verdict/verdict.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "ballbar/diagnosis/statistics/thresholds.hpp"
#include "ballbar/numerics/range.hpp"
#include "diagnosis/search/competing_subsets.hpp"
#include "diagnosis/search/nested_effects.hpp"
#include "diagnosis/statistics/cross_validation.hpp"
#include "diagnosis/statistics/gain_tests.hpp"
#include "diagnosis/statistics/gaussian_process_alternative.hpp"
#include "diagnosis/statistics/outliers.hpp"
#include "diagnosis/verdict/associations.hpp"
#include "diagnosis/verdict/candidates.hpp"
#include "series/folds.hpp"

namespace ballbar {
namespace {

using Groups = std::vector<std::vector<BoundEffect>>;

struct Case {
  const SubsetFits& now;
  const Series& rows;
  const Fit& base;
  const NullModel& null_model;
  const std::vector<SubsetFit>& refits;
  const DiagnosisOptions& options;
  std::vector<std::size_t> fold;

  const SubsetFit& best() const { return refits.front(); }
  bool of_recordings() const { return now.model().level == Level::recording; }
  double held_out_um(const LinearisedFit& linearised, const Noise& noise) const {
    return cross_validation(linearised, noise, fold, of_recordings()).rmse_um;
  }
};

bool is_in(const std::vector<BoundEffect>& group, const BoundEffect& bound) {
  return std::find(group.begin(), group.end(), bound) != group.end();
}

bool is_in(const Groups& groups, const BoundEffect& bound) {
  return std::any_of(groups.begin(), groups.end(),
                     [&](const std::vector<BoundEffect>& group) { return is_in(group, bound); });
}

// Thresholds hold for the noise that explains most by itself; where an effect is much, the likelihood with the noise
// estimated anew has its own word.
bool is_something(const Case& c, double p_anything) {
  const double alone = 2.0 * c.null_model.log_likelihood;
  return p_anything < kErrorOfASearch && std::any_of(c.refits.begin(), c.refits.end(), [&](const SubsetFit& one) {
           return one.penalised > alone || 2.0 * one.noise_fit.log_likelihood - alone >
                                               kLeastLikelihoodRatio * static_cast<double>(one.set.size());
         });
}

Finding unexplained(const Case& c, std::vector<std::string> reasons) {
  return {Verdict::unexplained, {}, {}, associations(c.now, c.null_model.noise, c.fold), std::move(reasons)};
}

// Where no effect is found: what is more than noise all the same.
Finding anything_else(const Case& c, double smooth_likelihood_ratio) {
  if (smooth_likelihood_ratio > kSmoothLikelihoodRatio) {
    return unexplained(c, {"Something slow is left, and no effect of the catalogue has its shape."});
  }
  if (!c.null_model.heavy_tails) return {};
  const Outliers far = outliers(c.null_model.seen.residual, c.rows, c.base.row);
  if (!(far.p < kClustered)) return {};
  return unexplained(c, {fmt::format("Of {} readings beyond 4 sigma {} lie within {:.0f} min after a change of speed.",
                                     far.count, far.after_changes, kAfterChange_s / 60.0)});
}

// Sets that may be it as well.
std::vector<const SubsetFit*> open_competitors(const Case& c) {
  std::vector<const SubsetFit*> competitors;
  for (const SubsetFit& other : c.refits) {
    if (&other != &c.best() && is_open_between(c.best(), other)) competitors.push_back(&other);
  }
  return competitors;
}

// What the competitors draw the effect at `place` of the best set with.
std::vector<std::string> also_drawn_by(const Case& c, const std::vector<const SubsetFit*>& competitors,
                                       std::size_t place) {
  std::vector<std::string> same;
  for (const SubsetFit* other : competitors) {
    for (std::size_t k = 0; k < other->set.size(); ++k) {
      if (!draws_the_same(c.now, c.best(), place, *other, k)) continue;
      const std::string label = label_of(c.now.bound(other->set[k]));
      if (std::find(same.begin(), same.end(), label) == same.end()) same.push_back(label);
    }
  }
  return same;
}

// Every effect of the best set beside the rest of it.
std::vector<Candidate> confirmed_set(const Case& c, const std::vector<const SubsetFit*>& competitors) {
  const SubsetFit& best = c.best();
  std::vector<Candidate> candidates;
  for (std::size_t m = 0; m < best.set.size(); ++m) {
    Candidate one = confirmed(c.now, c.rows, best, m, c.null_model.null, c.options);
    if (best.set.size() == 1) {  // whichever model without it is more likely
      one.likelihood_ratio =
          std::min(one.likelihood_ratio, 2.0 * (best.noise_fit.log_likelihood - c.null_model.log_likelihood));
    }
    one.minor = one.amplitude_um < std::max(kMinor * c.base.rmse_um, c.options.tolerance_um);
    one.also_drawn_by = also_drawn_by(c, competitors, m);
    candidates.push_back(std::move(one));
  }
  return candidates;
}

std::vector<std::string> doubts_of(const std::vector<Candidate>& tested) {
  std::vector<std::string> sentences;
  for (const Candidate& one : tested) {
    for (const std::string& doubt : one.doubts) sentences.push_back(fmt::format("{}: {}.", one.label, doubt));
  }
  return sentences;
}

// The fitted set without one of its effects: one of those that were fitted, or anew.
SubsetFit others_of(const Case& c, const SubsetFit& whole, std::size_t place) {
  const auto same = std::find_if(c.refits.begin(), c.refits.end(), [&](const SubsetFit& other) {
    return is_without(c.now, other.set, whole.set, place);
  });
  return same != c.refits.end() ? *same : c.now.without(whole, place);
}

// Beside the others of its own set.
Candidate candidate_beside(const Case& c, const SubsetFit& with, std::size_t place, double base_held_out_um) {
  Candidate candidate = candidate_of(c.now, with, place);
  const Effect& effect = *candidate.bound.effect;
  candidate.threshold = c.null_model.null.threshold(effect);
  candidate.likelihood_ratio = 2.0 * (with.noise_fit.log_likelihood - c.null_model.log_likelihood);
  candidate.held_out_before_um = base_held_out_um;
  if (with.set.size() > 1) {
    const SubsetFit others = others_of(c, with, place);
    candidate.likelihood_ratio = 2.0 * (with.noise_fit.log_likelihood - others.noise_fit.log_likelihood);
    candidate.held_out_before_um = c.held_out_um(others.noise_fit.linearised, others.noise_fit.noise);
  }
  candidate.p_search = c.null_model.null.p_search(effect, candidate.likelihood_ratio);
  candidate.held_out_after_um = c.held_out_um(with.noise_fit.linearised, with.noise_fit.noise);
  return candidate;
}

// Beside those of the best set whatever may be it, then the strongest of the others.
std::vector<Candidate> with_competitors(const Case& c, const Groups& groups,
                                        const std::vector<const SubsetFit*>& competitors,
                                        std::vector<Candidate> candidates) {
  const double base_held_out_um = c.held_out_um(c.now.linearised(), c.null_model.noise);
  const auto show = [&](const SubsetFit& other, std::size_t place) {
    const BoundEffect& bound = c.now.bound(other.set[place]);
    const bool there = std::any_of(candidates.begin(), candidates.end(),
                                   [&](const Candidate& candidate) { return candidate.bound == bound; });
    if (!there) candidates.push_back(candidate_beside(c, other, place, base_held_out_um));
  };
  for (const SubsetFit* competitor : competitors) {
    for (std::size_t m = 0; m < competitor->set.size() && candidates.size() < kShownInQuestion; ++m) {
      if (is_in(groups, c.now.bound(competitor->set[m]))) show(*competitor, m);
    }
  }
  for (const SubsetFit& other : c.refits) {
    for (std::size_t m = 0; m < other.set.size() && candidates.size() < kShown; ++m) show(other, m);
  }
  for (const std::vector<BoundEffect>& group : groups) {
    for (Candidate& candidate : candidates) {
      if (!is_in(group, candidate.bound)) continue;
      for (const BoundEffect& other : group) {
        if (!(other == candidate.bound)) candidate.inseparable_from.push_back(label_of(other));
      }
    }
  }
  return candidates;
}

// Whether the best set leaves noise, as far as a smooth curve and its spectrum tell.
bool is_adequate(const SubsetFit& best) {
  const NoiseFit& noise_fit = best.noise_fit;
  const double smooth = 2.0 * (gaussian_process_alternative(noise_fit.linearised, noise_fit.noise).log_likelihood -
                               noise_fit.log_likelihood);
  Fit left = noise_fit.fit;
  left.noise = noise_fit.noise;
  return smooth < kSmoothLikelihoodRatio && whiteness(left).p >= kWhite;
}

// A gain that varies from cycle to cycle, or nothing but an effect at the edge of its shapes: something like it.
bool is_contradicted(const std::vector<Candidate>& tested, const Groups& groups) {
  for (std::size_t m = 0; m < groups.size(); ++m) {
    if (tested[m].p_same_gain < kSameGain) return true;
    if (groups[m].size() == 1 && is_at_the_edge(tested[m])) return true;
  }
  return false;
}

// Effects that go much farther than all of them together: what they draw is a small difference of large curves, which
// imitates what none of them is.
bool nearly_cancel(const Case& c) {
  const SubsetFit& best = c.best();
  std::vector<double> together(best.noise_fit.fit.row.size(), 0.0);
  double farthest = 0.0;
  for (std::size_t m = 0; m < best.set.size(); ++m) {
    const std::vector<double>& one = best.noise_fit.fit.contribution_um[c.now.model().terms.size() + m];
    for (std::size_t i = 0; i < one.size(); ++i) together[i] += one[i];
    farthest = std::max(farthest, range_of(one));
  }
  return farthest > kCancels * range_of(together);
}

// tested: those of the best set, a group each.
Finding decided(const Case& c, const std::vector<Candidate>& tested, const Groups& groups, bool beats_smooth) {
  if (!is_adequate(c.best())) return unexplained(c, {"What the best effects leave is not noise."});
  if (!beats_smooth) return unexplained(c, {"A smooth curve without any cause explains the data better."});
  if (is_contradicted(tested, groups)) return unexplained(c, {});
  Finding finding;
  const bool cancel = nearly_cancel(c);
  if (cancel) {
    finding.reasons.emplace_back(
        "The best effects nearly cancel: a difference of large curves imitates much, so that none of them is named.");
  }
  for (std::size_t m = 0; m < groups.size(); ++m) {
    if (!cancel && groups[m].size() == 1 && tested[m].doubts.empty()) {
      finding.named.push_back(groups[m].front());
    } else {
      finding.equivalent.push_back(groups[m]);
    }
  }
  finding.verdict = finding.named.empty() ? Verdict::equivalent : Verdict::named;
  return finding;
}

std::vector<std::string> both(std::vector<std::string> first, const std::vector<std::string>& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

}  // namespace

Findings findings_of(const SubsetFits& now, const Series& rows, const Fit& base, const NullModel& null_model,
                     double p_anything, const std::vector<SubsetFit>& refits, const DiagnosisOptions& options) {
  const Case c{now, rows, base, null_model, refits, options, folds_of(rows, base.row)};
  now.tell("fitting smooth curves");
  const GaussianProcessAlternative smooth =
      gaussian_process_alternative(now.linearised(), now.has_few_rows() ? null_model.noise : null_model.base_noise);
  Findings result;
  result.smooth_likelihood_ratio = 2.0 * (smooth.log_likelihood - null_model.log_likelihood);
  const bool something = is_something(c, p_anything);
  if (!something) result.finding = anything_else(c, result.smooth_likelihood_ratio);
  if (refits.empty()) return result;
  const std::vector<const SubsetFit*> competitors = open_competitors(c);
  const std::vector<Candidate> tested = confirmed_set(c, competitors);
  const Groups groups = groups_of(now, null_model.seen, c.best(), competitors);
  result.candidates = with_competitors(c, groups, competitors, tested);
  const std::vector<std::string> doubts = doubts_of(tested);
  if (something) {
    result.finding = decided(c, tested, groups, c.best().noise_fit.log_likelihood > smooth.log_likelihood);
    result.finding.reasons = both(doubts, result.finding.reasons);
  } else {
    result.finding.reasons = both(std::move(result.finding.reasons), doubts);
  }
  return result;
}

}  // namespace ballbar
