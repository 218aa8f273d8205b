#include "diagnosis/posterior/sets.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "ballbar/internal/numerics/parallel.hpp"
#include "diagnosis/evidence/linear_model.hpp"
#include "diagnosis/posterior/conditional_fit.hpp"
#include "diagnosis/posterior/hyperparameters.hpp"

namespace ballbar {
namespace {

// A choice for one single effect: an identity or none, and its P.
struct Choice {
  std::size_t identity = kNoSignature;
  double p = 0.0;
};

struct IdentityChoice {
  double p = 1.0;
  std::vector<std::size_t> identities;  // of each single effect
  std::size_t mode = 0;
};

std::vector<std::vector<Choice>> choices_of(const PosteriorMode& mode, std::size_t families_of_effects,
                                            std::size_t families, const Tuning& tuning) {
  std::vector<std::vector<Choice>> all;
  for (const SinglePosterior& one : mode.effects) {
    std::vector<Choice> choices;
    double none = 1.0;
    for (std::size_t i = 0; i < one.alpha.size(); ++i) {
      none -= one.alpha[i];
      const bool is_form = i >= families_of_effects && i < families;
      if (one.alpha[i] > tuning.least_of_set && !is_form) choices.push_back({i, one.alpha[i]});
    }
    choices.push_back({kNoSignature, std::max(0.0, none)});
    std::stable_sort(choices.begin(), choices.end(), [](const Choice& a, const Choice& b) { return a.p > b.p; });
    all.push_back(std::move(choices));
  }
  return all;
}

// All sufficiently probable combinations of choices.
std::vector<IdentityChoice> drawn(const std::vector<std::vector<Choice>>& choices, const Tuning& tuning) {
  std::vector<IdentityChoice> all{{}};
  for (const std::vector<Choice>& of_one : choices) {
    std::vector<IdentityChoice> next;
    for (const IdentityChoice& before : all) {
      for (const Choice& choice : of_one) {
        if (before.p * choice.p < tuning.least_of_set) break;
        next.push_back(before);
        next.back().p *= choice.p;
        next.back().identities.push_back(choice.identity);
      }
    }
    std::stable_sort(next.begin(), next.end(),
                     [](const IdentityChoice& a, const IdentityChoice& b) { return a.p > b.p; });
    if (next.size() > tuning.most_sets) next.resize(tuning.most_sets);
    all = std::move(next);
  }
  return all;
}

// The model of a mode with a held value at another one.
std::size_t linearisation_with_held(const Problem& problem, Posterior& posterior, std::size_t mode, std::size_t held,
                                    double value) {
  const Linearisation& of_mode = posterior.linearisations[mode];
  std::vector<double> parameters = of_mode.parameters;
  parameters[problem.held[held].parameter] = value;
  Linearisation linearisation = linearisation_at(problem, held, std::move(parameters), of_mode.open);
  posterior.linearisations.push_back(std::move(linearisation));
  return posterior.linearisations.size() - 1;
}

// Linearises a model with a held value at another one about its most likely parameters beside the effects of the set:
// the value that the search found lies on a coarse grid.
void relinearise_held(const Problem& problem, Posterior& posterior, EffectSet& set) {
  if (!set.freed) return;
  const Linearisation& linearisation = posterior.linearisations[set.linearisation];
  ConditionalFit conditional = conditional_fit(problem, linearisation, set.signatures, posterior.filters[set.filter]);
  Linearisation about = linearisation_at(problem, set.freed, std::move(conditional.parameters), linearisation.open);
  posterior.linearisations.push_back(std::move(about));
  set.linearisation = posterior.linearisations.size() - 1;
}

// The model with exactly these effects, at the likeliest covariance of each kind of discrepancy.
struct GivenEffects {
  std::vector<Covariance> covariances;
  std::vector<SumOfEffects> sums;
  std::vector<double> log_weight;
  Identities identities;
};

GivenEffects given_effects(const Problem& problem, const Posterior& posterior,
                           const std::vector<std::size_t>& families) {
  GivenEffects result;
  const Linearisation& linearisation = posterior.linearisations.front();
  result.identities = restricted(posterior.identities, families);
  const bool is_given = !problem.covariances.empty();
  result.covariances = posterior.kinds;
  const IbssOptions options =
      with_exactly(ibss_options(problem, result.identities, families.size(), Forms::yes), families);
  // Without effects the model may have other parameters than with the best set.
  std::optional<Linearisation> alone;
  std::vector<const Linearisation*> linearisations{&linearisation};
  if (families.empty())
    linearisations.push_back(&alone.emplace(linearisation_at(problem, std::nullopt, fitted_parameters(problem))));
  result.sums.resize(result.covariances.size());
  result.log_weight.assign(result.covariances.size(), kLogZero);
  in_parallel(result.covariances.size(), [&](std::size_t g) {
    const Covariance start = result.covariances[g];
    for (const Linearisation* one : linearisations) {
      SumOfEffects sum;
      Covariance covariance = start;
      for (int round = 0; round < (is_given ? 1 : 2); ++round) {
        // The covariance of the kind was found beside effects.
        if (round > 0 || families.empty())
          covariance = covariance_beside(problem, sum, result.identities, one->linear, covariance);
        sum = sum_at(problem, result.identities, one->linear, covariance, options, std::move(sum));
        const double log_weight = sum.elbo + covariance.log_prior;
        if (!(log_weight > result.log_weight[g])) continue;
        result.log_weight[g] = log_weight;
        result.sums[g] = sum;
        result.covariances[g] = covariance;
      }
    }
  });
  return result;
}

}  // namespace

std::optional<std::size_t> signature_of(Problem& problem, const Identities& identities, std::size_t shape) {
  const Shape& one = identities.shapes[shape];
  if (one.signature != kNoSignature) return one.signature;
  if (identities.jump != one.identity) return std::nullopt;
  return signature_of_jump(problem, identities, static_cast<std::size_t>(one.first - identities.columns.cols()));
}

void add_sets(Problem& problem, const std::vector<ModeOfSets>& modes, Posterior& posterior) {
  const std::size_t families = modes.front().identities.families;
  std::map<std::pair<std::vector<std::size_t>, std::optional<std::size_t>>, std::size_t> place;
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> with_held;  // of a mode
  // The best set first: the most likely identity of each single effect that is more likely present than absent.
  const PosteriorMode& likeliest = posterior.modes.front();
  std::vector<IdentityChoice> all{{likeliest.p, {}, 0}};
  all.front().identities.reserve(likeliest.effects.size());
  for (const SinglePosterior& one : likeliest.effects) {
    std::size_t identity = kNoSignature;
    double p = 0.0;
    for (std::size_t i = 0; i < one.alpha.size(); ++i) {
      const bool is_form = i >= problem.effects && i < families;
      if (!is_form && one.alpha[i] > p) p = one.alpha[identity = i];
    }
    const bool is_there = one.p_any() >= 0.5 && p > 0.0;
    all.front().identities.push_back(is_there ? identity : kNoSignature);
    all.front().p *= is_there ? p : 1.0 - one.p_any();
  }
  all.push_back({posterior.none, std::vector<std::size_t>(likeliest.effects.size(), kNoSignature), 0});
  for (std::size_t m = 0; m < modes.size(); ++m) {
    const PosteriorMode& mode = posterior.modes[m];
    for (IdentityChoice& one : drawn(choices_of(mode, problem.effects, families, problem.tuning), problem.tuning)) {
      one.p *= mode.p;
      one.mode = m;
      all.push_back(std::move(one));
    }
  }
  std::size_t by_themselves = 0;  // sets of the first two choices, whose P is theirs
  for (std::size_t d = 0; d < all.size(); ++d) {
    if (d <= 2) by_themselves = posterior.sets.size();
    const std::size_t mode = all[d].mode;
    const Identities& identities = modes[mode].identities;
    const std::vector<SingleEffect>& effects = modes[mode].likeliest.effects;
    EffectSet set;
    set.filter = modes[mode].filter;
    set.linearisation = mode;
    std::vector<std::array<std::size_t, 3>> members;  // family, signature, single effect
    bool is_whole = true;
    for (std::size_t l = 0; l < all[d].identities.size() && is_whole; ++l) {
      const std::size_t identity = all[d].identities[l];
      if (identity == kNoSignature) continue;
      std::size_t shape = l < effects.size() ? effects[l].likeliest[identity] : kNoSignature;
      if (shape == kNoSignature) shape = identities.first[identity];
      is_whole = identities.count[identity] > 0;
      if (!is_whole) continue;
      if (identities.is_held_value(identity)) {
        if (set.freed) continue;
        set.freed = identity - families;
        const auto [at, is_new] = with_held.try_emplace({mode, *set.freed}, 0);
        if (is_new)
          at->second = linearisation_with_held(problem, posterior, mode, *set.freed, identities.shapes[shape].value);
        set.linearisation = at->second;
        continue;
      }
      if (std::any_of(members.begin(), members.end(), [&](const auto& one) { return one[0] == identity; })) continue;
      const auto signature = signature_of(problem, identities, shape);
      is_whole = signature.has_value();
      if (signature) members.push_back({identity, *signature, l});
    }
    if (!is_whole) continue;
    std::sort(members.begin(), members.end());
    for (const auto& [family, signature, single] : members) {
      set.families.push_back(family);
      set.signatures.push_back(signature);
      if (mode == 0) set.single.push_back(single);
    }
    const auto [known, is_new] = place.try_emplace({set.families, set.freed}, posterior.sets.size());
    const double p = std::max(1e-300, all[d].p);
    if (!is_new) {
      const bool is_counted = known->second < by_themselves && (mode == 0 || (set.families.empty() && !set.freed));
      if (d < 2 || is_counted) continue;
      posterior.sets[known->second].log_weight = std::log(std::exp(posterior.sets[known->second].log_weight) + p);
      continue;
    }
    set.log_weight = std::log(p);
    posterior.sets.push_back(std::move(set));
  }
  const EffectSet best = posterior.sets.front();
  std::stable_sort(posterior.sets.begin(), posterior.sets.end(),
                   [](const EffectSet& a, const EffectSet& b) { return a.log_weight > b.log_weight; });
  std::vector<double> weights;
  for (std::size_t s = 0; s < posterior.sets.size(); ++s) {
    weights.push_back(posterior.sets[s].log_weight);
    if (posterior.sets[s].families == best.families && posterior.sets[s].freed == best.freed) posterior.best = s;
  }
  posterior.log_total = log_sum(weights);
  relinearise_held(problem, posterior, posterior.sets[posterior.best]);
}

std::size_t set_of(Problem& problem, Posterior& posterior, std::vector<std::size_t> families) {
  std::sort(families.begin(), families.end());
  for (std::size_t s = 0; s < posterior.sets.size(); ++s) {
    if (!posterior.sets[s].freed && posterior.sets[s].families == families) return s;
  }
  const GivenEffects given = given_effects(problem, posterior, families);
  const auto g = static_cast<std::size_t>(std::max_element(given.log_weight.begin(), given.log_weight.end()) -
                                          given.log_weight.begin());
  EffectSet set;
  set.log_weight = kLogZero;
  set.families = families;
  for (std::size_t l = 0; l < families.size(); ++l) {
    const std::size_t shape = given.sums[g].effects[l].likeliest[families[l]];
    const auto signature = shape == kNoSignature ? std::nullopt : signature_of(problem, given.identities, shape);
    set.signatures.push_back(signature.value_or(problem.library.families[families[l]].first));
  }
  const auto same = std::find_if(posterior.filters.begin(), posterior.filters.end(),
                                 [&](const NoiseFilter& one) { return one.covariance == given.covariances[g]; });
  set.filter = static_cast<std::size_t>(same - posterior.filters.begin());
  if (same == posterior.filters.end()) {
    posterior.filters.push_back(noise_filter_at(problem, given.covariances[g]));
  }
  // The model beside these effects.
  const Linearisation& first = posterior.linearisations.front();
  ConditionalFit conditional =
      sharpened(problem, first, set.signatures, {first.parameters}, posterior.filters[set.filter]);
  set.signatures = conditional.signatures;
  posterior.linearisations.push_back(linearisation_at(problem, std::nullopt, std::move(conditional.parameters),
                                                      with_levels(problem, std::move(conditional.delays))));
  set.linearisation = posterior.linearisations.size() - 1;
  posterior.sets.push_back(std::move(set));
  return posterior.sets.size() - 1;
}

double log_bayes_factor(const Problem& problem, const Posterior& posterior, const std::vector<std::size_t>& families) {
  const auto log_evidence = [&](std::vector<std::size_t> of) {
    std::sort(of.begin(), of.end());
    const auto [known, is_new] = posterior.log_evidence.try_emplace(of, 0.0);
    if (is_new) known->second = log_sum(given_effects(problem, posterior, of).log_weight);
    return known->second;
  };
  return 2.0 * (log_evidence(families) - log_evidence({}));
}

}  // namespace ballbar
