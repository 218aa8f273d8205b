#include "ballbar/diagnosis.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "ballbar/trial.hpp"
#include "candidates.hpp"
#include "confirmation.hpp"
#include "correlates.hpp"
#include "cycles.hpp"
#include "held_out.hpp"
#include "prospects.hpp"
#include "rival_sets.hpp"
#include "search_null.hpp"
#include "smooth_rival.hpp"
#include "thinned.hpp"
#include "whitened.hpp"

namespace ballbar {
namespace {

constexpr double kChance = 0.01;
constexpr double kSmoothEvidence = 18.0;  // of a smooth curve that is more than noise
constexpr double kWhite = 0.001;
constexpr std::size_t kShown = 8;
constexpr std::size_t kShownInQuestion = 12;

// The fitted set without one of its effects: one of those that were fitted, or anew.
Refitted others_of(const Hypotheses& now, const std::vector<Refitted>& refits, const Refitted& whole,
                   std::size_t place) {
  const auto same = std::find_if(refits.begin(), refits.end(), [&](const Refitted& other) {
    if (other.set.size() + 1 != whole.set.size()) return false;
    for (std::size_t m = 0; m < whole.set.size(); ++m) {
      if (m != place && !has(now, other.set, now.bound(whole.set[m]))) return false;
    }
    return true;
  });
  return same != refits.end() ? *same : now.without(whole, place);
}

// Nothing is said of effects that are not searched.
std::vector<Prospect> prospects_but(const DiagnosisOptions& options, std::vector<Prospect> prospects) {
  std::erase_if(prospects, [&](const Prospect& one) {
    return std::find(options.without.begin(), options.without.end(), one.effect->name) != options.without.end();
  });
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

std::string label_of(const BoundEffect& bound) {
  // On recordings the columns are the trace's own.
  if (bound.columns.empty() || bound.effect->level == Level::recording) return bound.effect->name;
  return fmt::format("{}({})", bound.effect->name, fmt::join(bound.columns, ", "));
}

Diagnosis diagnose(const Model& model, const Series& data, std::size_t target, const DiagnosisOptions& options) {
  const Series rows = thinned(data, model.targets.at(target), options.most_rows);
  Diagnosis result;
  result.base = fit(model, rows, target);
  result.target = result.base.target;
  Hypotheses now(model, rows, target, result.base, options);
  std::set<const Effect*> searched;
  for (const Family& family : now.bank().families) searched.insert(family.effect);
  result.searched_effects = searched.size();
  const std::size_t largest = now.largest_set();
  if (now.bank().families.empty() || largest == 0) {
    result.verdict = Verdict::untestable;
    result.prospects = prospects_but(
        options, prospects_of(now.bank(), now.projected_by(result.base.noise), model, rows, options.motion));
    result.reasons.emplace_back(now.bank().families.empty() ? "No effect of the catalogue can be tested on these data."
                                                            : "There are too few values to test anything more.");
    return result;
  }

  now.tell(fmt::format("searching {} shapes of {} effects", now.bank().signatures.size(), searched.size()));
  const Noise base_noise = now.evaluated({}, result.base.noise).noise;
  double base_log_likelihood = now.evaluated({}, result.base.noise).log_likelihood;
  const Guess first = first_guess(now, base_noise, base_log_likelihood);
  const Eigen::MatrixXd first_columns = now.columns(first.set);
  const Noise noise =
      restricted_noise(now.leftover(), first_columns, now.evaluated(first.set, first.noise).residual_um);
  if (now.has_few_rows()) {
    now.forget();
    base_log_likelihood = now.evaluated({}, noise).log_likelihood;
  }
  const Projected seen = now.projected_by(noise);
  now.tell(fmt::format("searching {} data sets without any effect", options.draws));
  const SearchNull null = search_null(now.bank(), seen, now.leftover(), noise,
                                      plausible_noises(now.leftover(), first_columns, noise, 64, options.seed),
                                      options.draws, options.seed);
  result.prospects = prospects_but(options, prospects_of(now.bank(), seen, model, rows, options.motion));
  const Eigen::VectorXd score = scores(now.bank(), seen, clipped(seen.residual));
  result.smallest_um = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < now.bank().signatures.size(); ++i) {
    const Effect& effect = *now.family(i).effect;
    result.p_anything = std::min(result.p_anything, null.p_search(effect, score[static_cast<Eigen::Index>(i)]));
    if (seen.share[i] < 0.05) continue;
    const double um = std::sqrt(null.threshold(effect)) * now.at(i).range_um / seen.norm[i];
    if (um >= result.smallest_um) continue;
    result.smallest_um = um;
    result.smallest = now.bound(i);
  }

  const Ground ground{first, noise, seen, null, base_log_likelihood};
  const std::vector<Refitted> refits = rival_sets(now, ground);
  now.tell("fitting smooth curves");
  const SmoothRival smooth = smooth_rival(now.leftover(), now.has_few_rows() ? noise : base_noise);
  result.smooth_evidence = 2.0 * (smooth.log_likelihood - base_log_likelihood);
  // Thresholds hold for the noise that explains most by itself; where that is much, the likelihood with the noise
  // estimated anew has its own word.
  const bool something = result.p_anything < kChance && !refits.empty() &&
                         (refits.front().penalised > 2.0 * base_log_likelihood ||
                          2.0 * (refits.front().log_likelihood - base_log_likelihood) >
                              kFewestEvidence * static_cast<double>(refits.front().set.size()));
  const std::vector<std::size_t> cycle = cycles_of(rows, result.base.row);
  const auto unexplained = [&] {
    result.verdict = Verdict::unexplained;
    result.goes_with = correlates(now, noise, cycle);
  };
  if (!something && result.smooth_evidence > kSmoothEvidence) {
    unexplained();
    result.reasons.emplace_back("Something slow is left, and no effect of the catalogue has its shape.");
  }
  if (refits.empty()) return result;
  const Refitted& best = refits.front();
  result.rmse_after_um = rmse_after_um(now, best);

  // Every effect of the best set beside the rest of it.
  std::vector<bool> sound;
  for (std::size_t m = 0; m < best.set.size(); ++m) {
    Confirmed one = confirmed(now, rows, best, m, null, cycle, options);
    if (best.set.size() == 1) {  // whichever model without it is more likely
      one.candidate.evidence = std::min(one.candidate.evidence, 2.0 * (best.log_likelihood - base_log_likelihood));
    }
    one.candidate.minor = one.candidate.amplitude_um < std::max(0.05 * result.base.rmse_um, options.tolerance_um);
    sound.push_back(one.why_not.empty());
    result.best_fake_fall = std::max(result.best_fake_fall, one.best_fake_fall);
    result.reasons.insert(result.reasons.end(), one.why_not.begin(), one.why_not.end());
    result.candidates.push_back(std::move(one.candidate));
  }

  const SmoothRival remainder = smooth_rival(best.leftover, best.noise);
  const double left_evidence = 2.0 * (remainder.log_likelihood - best.log_likelihood);
  const bool beats_smooth = best.log_likelihood > smooth.log_likelihood;
  Fit left = best.fit;
  left.noise = best.noise;
  const Whiteness white = whiteness(left);
  const bool adequate = left_evidence < kSmoothEvidence && white.p >= kWhite;
  std::vector<const Refitted*> rivals;
  for (const Refitted& other : refits) {
    if (&other == &best || !is_open_between(best, other)) continue;
    rivals.push_back(&other);
    for (std::size_t m = 0; m < best.set.size(); ++m) {
      for (std::size_t k = 0; k < other.set.size(); ++k) {
        if (!draws_the_same(now, best, m, other, k)) continue;
        std::vector<std::string>& same = result.candidates[m].also_drawn_by;
        const std::string label = label_of(now.bound(other.set[k]));
        if (std::find(same.begin(), same.end(), label) == same.end()) same.push_back(label);
      }
    }
  }
  const std::vector<std::vector<BoundEffect>> groups = groups_of(now, seen, best, rivals);
  // Whatever may be it is shown, then the strongest of the others.
  const bool of_recordings = model.level == Level::recording;
  const double base_held_out_um = held_out(now.leftover(), noise, cycle, of_recordings).rmse_um;
  const auto show = [&](const Refitted& other, std::size_t m) {
    const BoundEffect bound = now.bound(other.set[m]);
    const bool there = std::any_of(result.candidates.begin(), result.candidates.end(),
                                   [&](const Candidate& candidate) { return candidate.bound == bound; });
    if (there) return;
    Candidate candidate = candidate_of(now, other, m);
    candidate.threshold = null.threshold(*bound.effect);
    candidate.evidence = 2.0 * (other.log_likelihood - base_log_likelihood);
    candidate.held_out_before_um = base_held_out_um;
    if (other.set.size() > 1) {
      const Refitted others = others_of(now, refits, other, m);
      candidate.evidence = 2.0 * (other.log_likelihood - others.log_likelihood);
      candidate.held_out_before_um = held_out(others.leftover, others.noise, cycle, of_recordings).rmse_um;
    }
    candidate.p_search = null.p_search(*bound.effect, candidate.evidence);
    candidate.held_out_after_um = held_out(other.leftover, other.noise, cycle, of_recordings).rmse_um;
    result.candidates.push_back(std::move(candidate));
  };
  const auto is_in_question = [&](const BoundEffect& bound) {
    return std::any_of(groups.begin(), groups.end(), [&](const std::vector<BoundEffect>& group) {
      return std::find(group.begin(), group.end(), bound) != group.end();
    });
  };
  for (const Refitted* rival : rivals) {
    for (std::size_t m = 0; m < rival->set.size() && result.candidates.size() < kShownInQuestion; ++m) {
      if (is_in_question(now.bound(rival->set[m]))) show(*rival, m);
    }
  }
  for (const Refitted& other : refits) {
    for (std::size_t m = 0; m < other.set.size() && result.candidates.size() < kShown; ++m) show(other, m);
  }
  for (const std::vector<BoundEffect>& group : groups) {
    for (Candidate& candidate : result.candidates) {
      if (std::find(group.begin(), group.end(), candidate.bound) == group.end()) continue;
      for (const BoundEffect& other : group) {
        if (!(other == candidate.bound)) candidate.inseparable_from.push_back(label_of(other));
      }
    }
  }
  if (!something) return result;

  if (!adequate) {
    unexplained();
    result.reasons.emplace_back("What the best effects leave is not noise.");
    return result;
  }
  if (!beats_smooth) {
    unexplained();
    result.reasons.emplace_back("A smooth curve without any cause explains the data better.");
    return result;
  }
  const bool varying =
      std::any_of(result.candidates.begin(), result.candidates.begin() + static_cast<std::ptrdiff_t>(best.set.size()),
                  [](const Candidate& candidate) { return candidate.p_same_gain < kSameGain; });
  if (varying) {
    unexplained();
    return result;
  }
  for (std::size_t m = 0; m < groups.size(); ++m) {
    if (groups[m].size() == 1 && sound[m]) {
      result.named.push_back(groups[m].front());
    } else {
      result.equivalent.push_back(groups[m]);
    }
  }
  result.verdict = result.named.empty() ? Verdict::equivalent : Verdict::named;
  return result;
}

}  // namespace ballbar
