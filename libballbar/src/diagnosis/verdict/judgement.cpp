#include "diagnosis/verdict/judgement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "ballbar/challenge/inject.hpp"
#include "ballbar/revision/trial.hpp"
#include "diagnosis/search/rival_sets.hpp"
#include "diagnosis/statistics/confirmation.hpp"
#include "diagnosis/statistics/held_out.hpp"
#include "diagnosis/statistics/outliers.hpp"
#include "diagnosis/statistics/smooth_rival.hpp"
#include "diagnosis/verdict/candidates.hpp"
#include "diagnosis/verdict/correlates.hpp"
#include "series/cycles.hpp"

namespace ballbar {
namespace {

constexpr double kChance = 0.01;
constexpr double kSmoothEvidence = 18.0;  // of a smooth curve that is more than noise
constexpr double kWhite = 0.001;
constexpr double kClustered = 0.001;  // chance of readings far from the others where they are
constexpr double kCancels = 1.5;      // times the range of all effects of a set together
constexpr std::size_t kShown = 8;
constexpr std::size_t kShownInQuestion = 12;

using Groups = std::vector<std::vector<BoundEffect>>;

struct Case {
  const Hypotheses& now;
  const Series& rows;
  const Ground& ground;
  const std::vector<Refitted>& refits;
  const DiagnosisOptions& options;
  std::vector<std::size_t> cycle;

  const Refitted& best() const { return refits.front(); }
  bool of_recordings() const { return now.model().level == Level::recording; }
  double held_out_um(const Leftover& leftover, const Noise& noise) const {
    return held_out(leftover, noise, cycle, of_recordings()).rmse_um;
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
  const double alone = 2.0 * c.ground.log_likelihood;
  return p_anything < kChance && std::any_of(c.refits.begin(), c.refits.end(), [&](const Refitted& one) {
           return one.penalised > alone ||
                  2.0 * one.log_likelihood - alone > kFewestEvidence * static_cast<double>(one.set.size());
         });
}

void unexplained(const Case& c, Diagnosis& result, const std::string& why) {
  result.verdict = Verdict::unexplained;
  result.goes_with = correlates(c.now, c.ground.noise, c.cycle);
  if (!why.empty()) result.reasons.push_back(why);
}

// Where no effect is found: what is more than noise all the same.
void look_for_anything_else(const Case& c, Diagnosis& result) {
  if (result.smooth_evidence > kSmoothEvidence) {
    unexplained(c, result, "Something slow is left, and no effect of the catalogue has its shape.");
    return;
  }
  if (!c.ground.heavy_tails) return;
  const Outliers far = outliers(c.ground.seen.residual, c.rows, result.base.row);
  if (!(far.p < kClustered)) return;
  unexplained(c, result,
              fmt::format("Of {} readings beyond 4 sigma {} lie within {:.0f} min after a change of speed.", far.count,
                          far.after_changes, kAfterChange_s / 60.0));
}

// Every effect of the best set beside the rest of it, as the first candidates.
std::vector<Confirmed> confirm(const Case& c, Diagnosis& result) {
  const Refitted& best = c.best();
  std::vector<Confirmed> confirmations;
  for (std::size_t m = 0; m < best.set.size(); ++m) {
    Confirmed one = confirmed(c.now, c.rows, best, m, c.ground.null, c.cycle, c.options);
    if (best.set.size() == 1) {  // whichever model without it is more likely
      one.candidate.evidence = std::min(one.candidate.evidence, 2.0 * (best.log_likelihood - c.ground.log_likelihood));
    }
    one.candidate.minor = one.candidate.amplitude_um < std::max(0.05 * result.base.rmse_um, c.options.tolerance_um);
    result.best_fake_fall = std::max(result.best_fake_fall, one.best_fake_fall);
    result.reasons.insert(result.reasons.end(), one.why_not.begin(), one.why_not.end());
    result.candidates.push_back(one.candidate);
    confirmations.push_back(std::move(one));
  }
  return confirmations;
}

// Sets that may be it as well; what they draw with other effects is told beside the candidates.
std::vector<const Refitted*> open_rivals(const Case& c, Diagnosis& result) {
  std::vector<const Refitted*> rivals;
  for (const Refitted& other : c.refits) {
    if (&other == &c.best() || !is_open_between(c.best(), other)) continue;
    rivals.push_back(&other);
    for (std::size_t m = 0; m < c.best().set.size(); ++m) {
      for (std::size_t k = 0; k < other.set.size(); ++k) {
        if (!draws_the_same(c.now, c.best(), m, other, k)) continue;
        std::vector<std::string>& same = result.candidates[m].also_drawn_by;
        const std::string label = label_of(c.now.bound(other.set[k]));
        if (std::find(same.begin(), same.end(), label) == same.end()) same.push_back(label);
      }
    }
  }
  return rivals;
}

// The fitted set without one of its effects: one of those that were fitted, or anew.
Refitted others_of(const Case& c, const Refitted& whole, std::size_t place) {
  const auto same = std::find_if(c.refits.begin(), c.refits.end(),
                                 [&](const Refitted& other) { return is_without(c.now, other.set, whole.set, place); });
  return same != c.refits.end() ? *same : c.now.without(whole, place);
}

// Beside the others of its own set.
Candidate candidate_beside(const Case& c, const Refitted& with, std::size_t place, double base_held_out_um) {
  Candidate candidate = candidate_of(c.now, with, place);
  const Effect& effect = *candidate.bound.effect;
  candidate.threshold = c.ground.null.threshold(effect);
  candidate.evidence = 2.0 * (with.log_likelihood - c.ground.log_likelihood);
  candidate.held_out_before_um = base_held_out_um;
  if (with.set.size() > 1) {
    const Refitted others = others_of(c, with, place);
    candidate.evidence = 2.0 * (with.log_likelihood - others.log_likelihood);
    candidate.held_out_before_um = c.held_out_um(others.leftover, others.noise);
  }
  candidate.p_search = c.ground.null.p_search(effect, candidate.evidence);
  candidate.held_out_after_um = c.held_out_um(with.leftover, with.noise);
  return candidate;
}

// Whatever may be it is shown, then the strongest of the others.
void show_rivals(const Case& c, const Groups& groups, const std::vector<const Refitted*>& rivals, Diagnosis& result) {
  const double base_held_out_um = c.held_out_um(c.now.leftover(), c.ground.noise);
  const auto show = [&](const Refitted& other, std::size_t place) {
    const BoundEffect bound = c.now.bound(other.set[place]);
    const bool there = std::any_of(result.candidates.begin(), result.candidates.end(),
                                   [&](const Candidate& candidate) { return candidate.bound == bound; });
    if (!there) result.candidates.push_back(candidate_beside(c, other, place, base_held_out_um));
  };
  for (const Refitted* rival : rivals) {
    for (std::size_t m = 0; m < rival->set.size() && result.candidates.size() < kShownInQuestion; ++m) {
      if (is_in(groups, c.now.bound(rival->set[m]))) show(*rival, m);
    }
  }
  for (const Refitted& other : c.refits) {
    for (std::size_t m = 0; m < other.set.size() && result.candidates.size() < kShown; ++m) show(other, m);
  }
  for (const std::vector<BoundEffect>& group : groups) {
    for (Candidate& candidate : result.candidates) {
      if (!is_in(group, candidate.bound)) continue;
      for (const BoundEffect& other : group) {
        if (!(other == candidate.bound)) candidate.inseparable_from.push_back(label_of(other));
      }
    }
  }
}

// Whether the best set leaves noise, as far as a smooth curve and its spectrum tell.
bool is_adequate(const Refitted& best) {
  const double smooth = 2.0 * (smooth_rival(best.leftover, best.noise).log_likelihood - best.log_likelihood);
  Fit left = best.fit;
  left.noise = best.noise;
  return smooth < kSmoothEvidence && whiteness(left).p >= kWhite;
}

// A gain that varies from cycle to cycle, or nothing but an effect at the edge of its shapes: something like it.
bool is_contradicted(const std::vector<Confirmed>& confirmations, const Groups& groups) {
  for (std::size_t m = 0; m < groups.size(); ++m) {
    if (confirmations[m].candidate.p_same_gain < kSameGain) return true;
    if (groups[m].size() == 1 && confirmations[m].at_the_edge) return true;
  }
  return false;
}

// Effects that go much farther than all of them together: what they draw is a small difference of large curves, which
// imitates what none of them is.
bool nearly_cancel(const Case& c) {
  const Refitted& best = c.best();
  std::vector<double> together(best.fit.row.size(), 0.0);
  double farthest = 0.0;
  for (std::size_t m = 0; m < best.set.size(); ++m) {
    const std::vector<double>& one = best.fit.contribution_um[c.now.model().terms.size() + m];
    for (std::size_t i = 0; i < one.size(); ++i) together[i] += one[i];
    farthest = std::max(farthest, range_of(one));
  }
  return farthest > kCancels * range_of(together);
}

void decide(const Case& c, const std::vector<Confirmed>& confirmations, const Groups& groups, bool beats_smooth,
            Diagnosis& result) {
  if (!is_adequate(c.best())) return unexplained(c, result, "What the best effects leave is not noise.");
  if (!beats_smooth) {
    return unexplained(c, result, "A smooth curve without any cause explains the data better.");
  }
  if (is_contradicted(confirmations, groups)) return unexplained(c, result, {});
  const bool cancel = nearly_cancel(c);
  if (cancel) {
    result.reasons.emplace_back(
        "The best effects nearly cancel: a difference of large curves imitates much, so that none of them is named.");
  }
  for (std::size_t m = 0; m < groups.size(); ++m) {
    if (!cancel && groups[m].size() == 1 && confirmations[m].why_not.empty()) {
      result.named.push_back(groups[m].front());
    } else {
      result.equivalent.push_back(groups[m]);
    }
  }
  result.verdict = result.named.empty() ? Verdict::equivalent : Verdict::named;
}

}  // namespace

void judge(const Hypotheses& now, const Series& rows, const Ground& ground, const std::vector<Refitted>& refits,
           const DiagnosisOptions& options, Diagnosis& result) {
  const Case c{now, rows, ground, refits, options, cycles_of(rows, result.base.row)};
  now.tell("fitting smooth curves");
  const SmoothRival smooth = smooth_rival(now.leftover(), now.has_few_rows() ? ground.noise : ground.base_noise);
  result.smooth_evidence = 2.0 * (smooth.log_likelihood - ground.log_likelihood);
  const bool something = is_something(c, result.p_anything);
  if (!something) look_for_anything_else(c, result);
  if (refits.empty()) return;
  result.rmse_after_um = rmse_after_um(now, c.best());
  const std::vector<Confirmed> confirmations = confirm(c, result);
  const std::vector<const Refitted*> rivals = open_rivals(c, result);
  const Groups groups = groups_of(now, ground.seen, c.best(), rivals);
  show_rivals(c, groups, rivals, result);
  if (something) decide(c, confirmations, groups, c.best().log_likelihood > smooth.log_likelihood, result);
}

}  // namespace ballbar
